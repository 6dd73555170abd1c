//! Tests of boxes against the picture and its pyramid: hidden and visible ones, large and small, at equal depth, and those that may not be culled.

use antumbra_shaders::jobs;

use super::bench::Bench;
use super::picture::{CLIP_FROM_RELATIVE, EYE, Rect, SIZE, WALL};
use super::pyramid;
use super::scene::Scene;
use super::trial::{Answer, Expected, Trial};
use crate::entities::GpuPartBox;
use crate::judge::{AT_MIDDLES, Eye, GpuJudgedView, HostDepth, JudgedInstance, Part};

/// A box, and what is known of it.
struct Case {
    place: &'static str,
    instance: JudgedInstance,
    /// Whether it was drawn before the test.
    seen: bool,
    /// What the test finds.
    found: Found,
}

/// What is found about a box, as `shared/slot_states.wgsl` numbers it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Found {
    Unknown,
    Visible,
    Hidden,
}

/// The parts of meshes: none, the left half of a box, and both its halves.
fn parts() -> [GpuPartBox; 4] {
    let [left, right] = [[0, 460], [614, 1023]];
    let part = |[low, high]: [u16; 2], following| {
        GpuPartBox::new([low, 0, 0], [high, 1023, 1023], following)
    };
    [
        GpuPartBox::default(),
        part(left, 0),
        part(left, 1),
        part(right, 0),
    ]
}

/// Depth of the boxes, from their near faces on.
const DEEP: f32 = 1.0 / 64.0;

fn cases(shutter: Option<&Rect>) -> Vec<Case> {
    let case = |place, rect: Rect, found| Case {
        place,
        instance: rect.judged(DEEP, Part::Both),
        seen: false,
        found,
    };
    let behind = 0.25;
    let mut cases = vec![
        case(
            "a large box behind the wall",
            Rect::new(8..40, 8..56, behind),
            Found::Hidden,
        ),
        case(
            "a box of ten pixels behind the wall",
            Rect::new(12..22, 30..40, behind),
            Found::Hidden,
        ),
        case(
            "a box of three pixels behind the wall",
            Rect::new(12..15, 12..15, behind),
            Found::Hidden,
        ),
        case(
            "a large box half behind the wall",
            Rect::new(30..70, 20..40, behind),
            Found::Visible,
        ),
        case(
            "a box of three pixels beside the wall",
            Rect::new(54..57, 16..19, behind),
            Found::Visible,
        ),
        case(
            "a large box beside the wall",
            Rect::new(52..98, 1..28, behind),
            Found::Visible,
        ),
        case(
            "a box before the wall",
            Rect::new(8..40, 8..56, 0.9375),
            Found::Visible,
        ),
        case(
            "a box with its face in the wall",
            Rect::new(8..40, 8..56, WALL.depth),
            Found::Visible,
        ),
        case(
            "a box outside of the view",
            Rect::new(220..240, 10..20, behind),
            Found::Unknown,
        ),
        case(
            "a box across the near plane",
            Rect::new(10..20, 10..20, 1.0 + DEEP / 2.0),
            Found::Visible,
        ),
    ];
    if shutter.is_some() {
        cases.push(case(
            "a box behind the shutter",
            Rect::new(70..90, 8..20, behind),
            Found::Visible,
        ));
    }
    for (place, first, found) in [
        (
            "a small box half behind the wall whose only part is behind it",
            1,
            Found::Hidden,
        ),
        (
            "a small box half behind the wall with a part beside it",
            2,
            Found::Visible,
        ),
    ] {
        let mut case = case(place, Rect::new(45..55, 30..40, behind), found);
        case.instance.traits |= first << 8;
        cases.push(case);
    }
    let hidden = Rect::new(8..40, 8..56, behind);
    cases.push(Case {
        place: "a box behind the wall that is never tested",
        instance: hidden.judged(DEEP, Part::Exempt),
        seen: false,
        found: Found::Visible,
    });
    cases.push(Case {
        place: "a box behind the wall that was drawn before",
        instance: hidden.judged(DEEP, Part::Both),
        seen: true,
        // It is tested when all is drawn.
        found: Found::Visible,
    });
    cases.push(Case {
        place: "a place without a box",
        instance: JudgedInstance::default(),
        seen: false,
        found: Found::Unknown,
    });
    cases
}

/// Records the trial.
pub(super) fn record(bench: &mut Bench<'_>, scene: &Scene) -> Trial {
    let pyramid = pyramid::make(bench, scene);
    let samples = bench.samples;
    let host = HostDepth {
        samples,
        ..HostDepth::default()
    };
    let cases = cases(bench.shutter());
    let count = cases.len();
    let flags = if samples == 1 { AT_MIDDLES } else { 0 };
    let eye = Eye::new(CLIP_FROM_RELATIVE, EYE);
    let view = GpuJudgedView::new(&eye, SIZE, host, count as u32, flags);
    let instances: Vec<_> = cases.iter().map(|case| case.instance).collect();
    let seen: Vec<_> = cases.iter().map(|case| u32::from(case.seen)).collect();
    let storage = wgpu::BufferUsages::STORAGE;
    let view = bench.buffer(&[view], wgpu::BufferUsages::UNIFORM);
    let instances = bench.buffer(&instances, storage);
    let seen = bench.buffer(&seen, storage);
    let parts = bench.buffer(&parts(), storage);
    let [found, rest, drawn] = [(); 3].map(|()| bench.zeroes(count));
    let job = match samples {
        1 => &jobs::test_slots_one::JOB,
        _ => &jobs::test_slots_many::JOB,
    };
    let pipeline = bench.gpu.compute_pipeline(job, "test_slots");
    let binds = [
        (0, view.as_entire_binding()),
        (1, instances.as_entire_binding()),
        (2, seen.as_entire_binding()),
        (3, found.as_entire_binding()),
        (4, rest.as_entire_binding()),
        (5, pyramid.layout.as_entire_binding()),
        (6, pyramid.texels.as_entire_binding()),
        (7, wgpu::BindingResource::TextureView(&scene.depth)),
        (8, drawn.as_entire_binding()),
        (9, parts.as_entire_binding()),
    ];
    let group = pipeline.group_of(bench.gpu, &binds);
    let mut pass = bench.encoder.begin_compute_pass(&Default::default());
    pipeline.dispatch_in(&mut pass, &group, [(count as u32).div_ceil(64), 1, 1]);
    drop(pass);

    let of = |what: &'static str, word: fn(&Case) -> u32| {
        cases.iter().map(move |case| Expected {
            answer: Answer::Number(word(case)),
            place: format!("{}, {what}", case.place),
        })
    };
    let expected = of("1 if it is visible, 2 if it is hidden", |case| {
        case.found as u32
    })
    .chain(of("1 if it is drawn besides", |case| {
        u32::from(case.found == Found::Visible && !case.seen)
    }))
    .chain(of("1 if it is drawn", |case| {
        u32::from(case.found == Found::Visible || case.seen)
    }))
    .collect();
    let start = bench.reads(found).start;
    bench.reads(rest);
    Trial {
        expected,
        bytes: start..bench.reads(drawn).end,
    }
}
