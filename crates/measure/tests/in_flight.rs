//! Accuracy with several frames in flight: late answers are exactly so many frames old, in every run and on every backend.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::Arc;

use antumbra_cull::Gpu;
use antumbra_demo_scenes::{GridOptions, grid};
use antumbra_measure::compare::{CompareOptions, Contender, compare};
use antumbra_measure::path::{CameraPath, Orbit};
use antumbra_measure::report::{AnswerReport, Report, StrategyReport};
use antumbra_measure::table::{Table, facts};
use antumbra_strategies::registry;
use antumbra_testing::{gpus, vulkan};

const POSES: usize = 8;
/// Every strategy that uses answers of earlier frames, with settings that err by lateness alone.
const LATE: [&str; 5] = [
    "coherent",
    "stereo-coherent",
    "occupancy-map",
    "chc-plus-plus",
    "three-pass:threshold=0:scale=1:occluders=full:occludees=full",
];

/// Strategies along a part of the grid's orbit.
fn compared(gpu: &Gpu, in_flight: u32, specs: &[&str]) -> Report {
    let mut scene = grid(GridOptions {
        per_side: 5,
        ..GridOptions::default()
    })
    .unwrap();
    let orbit = Orbit {
        distance: 22.0,
        height: 4.0,
        ..Orbit::grid(POSES)
    };
    let path = CameraPath::orbit(&orbit).unwrap();
    let registry = Arc::new(registry());
    let contenders: Vec<Contender> = specs
        .iter()
        .map(|spec| Contender::of(*spec, &registry, spec).unwrap())
        .collect();
    let options = CompareOptions {
        size: [128, 96],
        in_flight,
        least_seconds: 0.0,
        flip_poses: 1,
        ..CompareOptions::default()
    };
    let mut silent = |_| ();
    let all = compare(gpu, &mut scene, &path, &contenders, &options, &mut silent);
    all.unwrap().report
}

/// What does not depend on the clock.
fn verdicts(strategy: &StrategyReport) -> impl PartialEq + std::fmt::Debug + '_ {
    (
        &strategy.verdicts,
        &strategy.frames.wrong_pixels_percent,
        &strategy.frames.queries,
        &strategy.frames.drawn_triangles,
        &strategy.frames.answer_age,
    )
}

#[test]
fn answers_are_as_old_as_there_are_frames_in_flight() {
    for gpu in gpus() {
        for in_flight in 1..=3 {
            let report = compared(gpu, in_flight, &LATE);
            assert_eq!(report.scene.in_flight, Some(in_flight));
            let age = u64::from(in_flight);
            for strategy in &report.strategies {
                let expected = AnswerReport {
                    youngest: age,
                    oldest: age,
                    skipped: 0,
                };
                assert_eq!(strategy.answers, Some(expected), "{}", strategy.title());
                let ages: Vec<u64> = (0..POSES as u64)
                    .map(|pose| if pose < age { 0 } else { age })
                    .collect();
                assert_eq!(strategy.frames.answer_age, ages, "{}", strategy.title());
            }
        }
    }
}

#[test]
fn a_run_with_frames_in_flight_is_the_same_again() {
    for in_flight in [2, 3] {
        let [first, again] = [(); 2].map(|()| compared(vulkan(), in_flight, &LATE));
        for (one, other) in first.strategies.iter().zip(&again.strategies) {
            assert_eq!(verdicts(one), verdicts(other), "{}", one.title());
        }
    }
}

/// The path goes one way, so that older answers are about poses farther away.
#[test]
fn older_answers_are_worse_and_those_of_the_same_frame_do_not_age() {
    const NOW: &str = "coherent:latency=same-frame";
    let wrong = |in_flight| {
        let report = compared(vulkan(), in_flight, &["coherent", NOW]);
        let [late, now] = report.strategies.as_slice() else {
            panic!("two strategies");
        };
        assert_eq!(now.error.wrong_pixels_percent.max, 0.0);
        late.error.wrong_pixels_percent.mean
    };
    let [one, two, three] = [1, 2, 3].map(wrong);
    assert!(0.0 < one && one < two && two < three, "{one} {two} {three}");
}

#[test]
fn tables_and_facts_say_how_old_answers_are() {
    let report = compared(vulkan(), 3, &["frustum", "coherent", "depth-pyramid"]);
    let table = Table::new(&report);
    let column = table.columns.iter().position(|one| one.title == "answers");
    let cells = table
        .rows
        .iter()
        .map(|row| row.cells[column.unwrap()].text.as_str());
    assert_eq!(cells.collect::<Vec<_>>(), ["-", "3", "-"]);
    assert!(facts(&report)[0].contains("8 frames with 3 in flight"));
    let one = compared(vulkan(), 1, &["frustum"]);
    assert!(!facts(&one)[0].contains("in flight"));
}
