//! Frame-late read-back: each answer carries its frame and tag, is delivered once, can be dropped, and is never waited for.

use std::collections::VecDeque;
use std::sync::mpsc;

use antumbra_graph::{BufferDesc, CompileOptions, Graph, Host, LateResults, Mode, Plan};

use crate::device::{Gpu, vulkan};

/// Answers as the body saw them: frame, tag, and bytes as `u32`.
type Seen = (u64, u64, Vec<u32>);

struct Late {
    plan: Plan,
    number: Host<u64>,
    seen: mpsc::Receiver<Option<Seen>>,
}

/// A graph that uploads `number` and reads it back late, with the number as its tag. The reader is declared first.
fn graph(gpu: &Gpu, mode: Mode, frames_in_flight: u32, late_results: LateResults) -> Late {
    let mut g = Graph::new("late");
    let number = g.import_host::<u64>("number");
    let tag = g.host::<u64>("tag");
    let data = g.buffer("data", BufferDesc::new(16));
    let (sender, seen) = mpsc::channel();

    let mut node = g.host_node("read");
    let answers = node.read_previous(data, tag);
    node.bytes(|_| 7);
    node.side_effect().run(move |ctx| {
        let late = ctx.late(answers);
        let again = ctx.late(answers);
        assert_eq!(late.map(|l| l.frame), again.map(|l| l.frame));
        let late = late.map(|late| {
            (
                late.frame,
                *late.tag,
                bytemuck::pod_collect_to_vec(late.bytes),
            )
        });
        sender.send(late).unwrap();
        Ok(())
    });

    let mut node = g.host_node("write");
    node.read(number);
    let (tag, data) = (node.write(tag), node.upload(data));
    node.run(move |ctx| {
        let number = *ctx.get(number)?;
        *ctx.get_mut(tag)? = number;
        let words = [number as u32, !(number as u32), 0, 0];
        ctx.upload(data, 0, bytemuck::cast_slice(&words))?;
        Ok(())
    });
    let options = CompileOptions {
        mode,
        frames_in_flight,
        late_results,
        ..CompileOptions::owned(&gpu.device)
    };
    Late {
        plan: g.compile(&options).unwrap(),
        number,
        seen,
    }
}

#[test]
fn an_answer_names_its_frame_and_carries_its_tag_once() {
    let gpu = vulkan();
    let mut late = graph(&gpu, Mode::Owned, 1, LateResults::Newest);
    let mut frames = Vec::new();
    for frame in 0..6_u64 {
        late.plan.set(late.number, 100 + frame).unwrap();
        let report = late.plan.execute(&gpu.device, &gpu.queue).unwrap();
        assert_eq!((report.frame, report.skipped_read_backs), (frame, 0));
        gpu.wait();
        if let Some((of, tag, words)) = late.seen.recv().unwrap() {
            assert_eq!(tag, 100 + of);
            assert_eq!(
                words,
                [tag as u32, !(tag as u32)],
                "7 bytes rounded up to 8"
            );
            assert!(of < frame, "an answer is of an earlier frame");
            frames.push(of);
        }
    }
    assert_eq!(frames, [0, 1, 2, 3, 4], "each answer once, in order");
}

#[test]
fn forgotten_answers_never_arrive() {
    let gpu = vulkan();
    let mut late = graph(&gpu, Mode::Owned, 1, LateResults::Newest);
    for frame in 0..4 {
        late.plan.set(late.number, frame).unwrap();
        late.plan.execute(&gpu.device, &gpu.queue).unwrap();
        gpu.wait();
        if frame == 2 {
            late.plan.discard_read_backs();
        }
    }
    let seen: Vec<_> = late.seen.try_iter().map(|seen| seen.map(|s| s.0)).collect();
    assert_eq!(seen, [None, Some(0), Some(1), None]);
}

/// A host may submit its encoders in another order than they were recorded in.
#[test]
fn an_older_answer_never_follows_a_newer_one() {
    let gpu = vulkan();
    let mut late = graph(&gpu, Mode::Embedded, 1, LateResults::Newest);
    let mut record = |number: u64| {
        late.plan.set(late.number, number).unwrap();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        late.plan
            .record(&gpu.device, &gpu.queue, &mut encoder)
            .unwrap();
        (
            encoder.finish(),
            late.seen.recv().unwrap().map(|seen| seen.0),
        )
    };
    let [(older, _), (newer, _)] = [record(0), record(1)];
    gpu.queue.submit([newer]);
    gpu.wait();
    let (next, seen) = record(2);
    assert_eq!(seen, Some(1));
    gpu.queue.submit([older]);
    gpu.wait();
    assert_eq!(record(3).1, None, "the answer of frame 0 comes too late");
    gpu.queue.submit([next]);
    gpu.wait();
    assert_eq!(record(4).1, Some(2));
}

#[test]
fn a_frame_without_a_free_slot_goes_on_and_says_so() {
    let gpu = vulkan();
    let mut late = graph(&gpu, Mode::Embedded, 1, LateResults::Newest);
    let mut skipped = 0;
    let mut encoders = Vec::new();
    for frame in 0..5 {
        late.plan.set(late.number, frame).unwrap();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let report = late
            .plan
            .record(&gpu.device, &gpu.queue, &mut encoder)
            .unwrap();
        skipped += report.skipped_read_backs;
        encoders.push(encoder.finish());
    }
    assert_eq!(
        skipped, 2,
        "nothing was submitted, so the three slots stayed taken"
    );
    gpu.queue.submit(encoders);
    gpu.wait();
    late.plan.set(late.number, 9).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    late.plan
        .record(&gpu.device, &gpu.queue, &mut encoder)
        .unwrap();
    let seen: Vec<_> = late.seen.try_iter().flatten().map(|seen| seen.0).collect();
    assert_eq!(seen, [2], "the newest of the three that had a slot");
}

#[test]
fn a_dropped_encoder_gives_its_slot_back() {
    let gpu = vulkan();
    let mut late = graph(&gpu, Mode::Embedded, 1, LateResults::Newest);
    for frame in 0..9 {
        late.plan.set(late.number, frame).unwrap();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let report = late
            .plan
            .record(&gpu.device, &gpu.queue, &mut encoder)
            .unwrap();
        assert_eq!(report.skipped_read_backs, 0);
    }
    assert!(late.seen.try_iter().flatten().next().is_none());
}

/// Waits for a submission: it is done then, and later ones need not be.
fn wait_for(gpu: &Gpu, submission: Option<wgpu::SubmissionIndex>) {
    let poll = wgpu::PollType::Wait {
        submission_index: submission,
        timeout: None,
    };
    gpu.device.poll(poll).unwrap();
}

/// A host that always has as many frames in flight as it said.
#[test]
fn every_answer_is_as_old_as_there_are_frames_in_flight_and_none_is_lost() {
    let gpu = vulkan();
    for in_flight in 1..=4_u32 {
        let mut late = graph(&gpu, Mode::Owned, in_flight, LateResults::OfFramesInFlight);
        let mut flying = VecDeque::new();
        for frame in 0..16_u64 {
            late.plan.set(late.number, 100 + frame).unwrap();
            let report = late.plan.execute(&gpu.device, &gpu.queue).unwrap();
            assert_eq!(report.skipped_read_backs, 0, "{in_flight} in flight");
            let age = u64::from(in_flight);
            let expected = frame.checked_sub(age);
            let seen = late.seen.recv().unwrap();
            assert_eq!(
                seen.as_ref().map(|seen| seen.0),
                expected,
                "{in_flight} in flight"
            );
            assert_eq!(seen.map(|seen| seen.1), expected.map(|of| 100 + of));
            let told: Vec<_> = report
                .late
                .iter()
                .map(|late| (late.node.as_str(), late.age))
                .collect();
            let should: Vec<_> = expected.map(|_| ("read", age)).into_iter().collect();
            assert_eq!(told, should);
            flying.push_back(report.submission);
            if flying.len() == in_flight as usize {
                wait_for(&gpu, flying.pop_front().flatten());
            }
        }
    }
}

/// What has arrived early is held back, so that the speed of a device decides nothing.
#[test]
fn an_answer_that_arrives_early_waits_for_its_frame() {
    let gpu = vulkan();
    let mut late = graph(&gpu, Mode::Owned, 3, LateResults::OfFramesInFlight);
    let mut newest = graph(&gpu, Mode::Owned, 3, LateResults::Newest);
    for frame in 0..8_u64 {
        for (graph, age) in [(&mut late, 3), (&mut newest, 1)] {
            graph.plan.set(graph.number, frame).unwrap();
            let report = graph.plan.execute(&gpu.device, &gpu.queue).unwrap();
            gpu.wait();
            assert_eq!(report.skipped_read_backs, 0);
            let seen = graph.seen.recv().unwrap().map(|seen| seen.0);
            assert_eq!(seen, frame.checked_sub(age));
        }
    }
}

/// A ring has two slots more than there are frames in flight: one frame more may be recorded, and loses nothing.
#[test]
fn a_host_with_one_frame_more_in_flight_loses_no_answer() {
    let gpu = vulkan();
    for in_flight in 1..=3_u32 {
        let mut late = graph(&gpu, Mode::Embedded, in_flight, LateResults::Newest);
        let mut flying = VecDeque::new();
        let mut seen = Vec::new();
        for frame in 0..12_u64 {
            late.plan.set(late.number, frame).unwrap();
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let report = late
                .plan
                .record(&gpu.device, &gpu.queue, &mut encoder)
                .unwrap();
            assert_eq!(report.skipped_read_backs, 0, "{in_flight} in flight");
            seen.extend(late.seen.recv().unwrap().map(|seen| seen.0));
            flying.push_back(encoder.finish());
            if flying.len() > in_flight as usize {
                gpu.queue.submit(flying.pop_front());
                gpu.wait();
            }
        }
        let all: Vec<_> = (0..seen.len() as u64).collect();
        assert_eq!(seen, all, "{in_flight} in flight: each once, in order");
        assert_eq!(seen.len(), 11 - in_flight as usize);
    }
}
