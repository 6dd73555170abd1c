//! Compaction: lists of candidates with counts become lists of what is kept, in order, and an indirect draw each.

use antumbra_shaders::jobs;

use super::bench::Bench;
use super::trial::{Answer, Expected, Trial};
use crate::compaction::{BLOCK, ENTRIES_A_THREAD, THREADS};
use crate::indirect::{BARRED, FORCED, GpuRun, GpuSettings, SampleBounds};

/// A list of candidates.
struct Batch {
    count: u32,
    bounds: SampleBounds,
}

const fn within(over: u32, most: u32) -> SampleBounds {
    SampleBounds {
        over,
        most,
        hidden: false,
    }
}

/// The second is longer than a workgroup takes at once; the third keeps what is hidden; the fourth keeps nothing.
const BATCHES: [Batch; 5] = [
    Batch {
        count: 40,
        bounds: SampleBounds::SEEN,
    },
    Batch {
        count: 1_100,
        bounds: within(3, 7),
    },
    Batch {
        count: 90,
        bounds: SampleBounds::HIDDEN,
    },
    Batch {
        count: 10,
        bounds: within(100, u32::MAX),
    },
    Batch {
        count: 1,
        bounds: SampleBounds::SEEN,
    },
];

/// The visible samples of a slot: 0 to 8, in no simple order.
fn samples_of(slot: u32) -> u32 {
    (slot.wrapping_mul(2_654_435_761) >> 16) % 9
}

/// Whether a candidate is kept; `mark` is one of [`FORCED`] and [`BARRED`], or 0.
fn is_kept(bounds: SampleBounds, samples: u32, mark: u32) -> bool {
    let inside = match bounds.hidden {
        true => samples == 0,
        false => samples > bounds.over && samples <= bounds.most,
    };
    mark == FORCED || inside && mark != BARRED
}

/// Records the trial.
pub(super) fn record(bench: &mut Bench<'_>) -> Trial {
    let all: u32 = BATCHES.iter().map(|batch| batch.count).sum();
    // Slots run against the order of the lists.
    let entry = |place: u32| {
        let mark = match place {
            _ if place % 97 == 5 => FORCED,
            _ if place % 89 == 7 => BARRED,
            _ => 0,
        };
        (all - 1 - place, mark)
    };
    let mut runs = Vec::new();
    let mut kept = Vec::new();
    let mut draws = Vec::new();
    let mut first = 0;
    for (number, Batch { count, bounds }) in (0u32..).zip(&BATCHES) {
        let run = GpuRun {
            first,
            count: *count,
            index_count: 6 + number,
            first_index: 60 + number,
            base_vertex: 4 - number as i32,
            over: bounds.over,
            most: bounds.most,
            hidden: u32::from(bounds.hidden),
        };
        let of_run = (first..first + count).map(entry);
        let of_run = of_run.filter(|(slot, mark)| is_kept(*bounds, samples_of(*slot), *mark));
        let slots: Vec<u32> = of_run.map(|(slot, _)| slot).collect();
        let words = [
            ("indices", run.index_count),
            ("instances", slots.len() as u32),
            ("first index", run.first_index),
            ("base vertex", run.base_vertex as u32),
            ("first instance", first),
        ];
        draws.extend(words.map(|(what, word)| Expected {
            answer: Answer::Number(word),
            place: format!("the draw of list {number}, its {what}"),
        }));
        // What lies after the kept slots of a list is not written.
        let unwritten = *count as usize - slots.len();
        let places = slots.into_iter().chain(std::iter::repeat_n(0, unwritten));
        kept.extend(places.enumerate().map(|(place, slot)| Expected {
            answer: Answer::Number(slot),
            place: format!("kept slot {place} of list {number}"),
        }));
        runs.push(run);
        first += count;
    }
    let entries: Vec<u32> = (0..all)
        .map(entry)
        .map(|(slot, mark)| slot | mark)
        .collect();
    let counts: Vec<u32> = (0..all).map(samples_of).collect();
    let storage = wgpu::BufferUsages::STORAGE;
    let settings = [GpuSettings::of(runs.len(), entries.len())];
    let settings = bench.buffer(&settings, storage);
    let [entries, counts] = [entries, counts].map(|words| bench.buffer(&words, storage));
    let lists = bench.buffer(&runs, storage);
    let kept_slots = bench.zeroes(kept.len());
    let written = bench.zeroes(draws.len());
    let marks = bench.zeroes(all.div_ceil(ENTRIES_A_THREAD) as usize);
    let blocks = bench.zeroes(all.div_ceil(BLOCK) as usize);
    let bound = [
        (0, &settings),
        (1, &lists),
        (2, &entries),
        (3, &counts),
        (4, &kept_slots),
        (5, &written),
        (6, &settings),
        (7, &marks),
        (8, &blocks),
    ];
    let threads = all.div_ceil(ENTRIES_A_THREAD);
    let steps: [(_, &[u32], _); 3] = [
        ("mark", &[0, 1, 2, 3, 6, 7, 8], all.div_ceil(BLOCK)),
        ("scan", &[0, 8], 1),
        (
            "gather",
            &[0, 1, 2, 4, 5, 7, 8],
            threads.max(runs.len() as u32).div_ceil(THREADS),
        ),
    ];
    for (entry, bindings, groups) in steps {
        let pipeline = bench.gpu.compute_pipeline(&jobs::compact::JOB, entry);
        let used = bound
            .iter()
            .filter(|(binding, _)| bindings.contains(binding))
            .map(|(binding, buffer)| (*binding, buffer.as_entire_binding()));
        let group = pipeline.group_of(bench.gpu, &used.collect::<Vec<_>>());
        let mut pass = bench.encoder.begin_compute_pass(&Default::default());
        pipeline.dispatch_in(&mut pass, &group, [groups, 1, 1]);
    }
    let start = bench.reads(kept_slots).start;
    Trial {
        expected: kept.into_iter().chain(draws).collect(),
        bytes: start..bench.reads(written).end,
    }
}
