//! A stage that is made on a faulty driver: it says what is wrong, and does without it.

use antumbra_cull::{
    Capability, Counting, DistrustCause, DistrustOptions, Gpu, Instead, Stage, StageOptions,
};
use antumbra_draw::GpuScene;
use antumbra_graph::Mode;
use antumbra_strategies::registry;
use antumbra_testing::{balls_with_proxies, frame, gpus, stage_with, views, wrong_pixels_percent};
use antumbra_verify::Oracle;

use crate::faults::{
    Fault, LOST_COUNT, LOST_COUNTS, LOST_DRAW, LOST_FIND, LOST_HISTOGRAM, LOST_SLOT, STALE_LEVEL,
    ZEROED_BOX_QUERY, ZEROED_MESH_QUERY,
};
use crate::trip_wire::{SIZE, camera};

const EXACT: &str =
    "three-pass:latency=same-frame:threshold=0:scale=1:occluders=full:occludees=full";

fn exact(counting: &str) -> String {
    format!("{EXACT}:counting={counting}")
}

fn scene_on(gpu: &Gpu) -> GpuScene {
    GpuScene::new(gpu, &mut balls_with_proxies(5)).unwrap()
}

fn made(scene: &GpuScene, strategy: &str, distrust: DistrustOptions) -> Stage {
    let options = StageOptions {
        distrust,
        ..StageOptions::default()
    };
    let strategy = registry().parse(strategy).unwrap();
    stage_with(scene, strategy, views(&["main"], SIZE), options)
}

/// Plays a few frames, and holds each against the oracle of a right device.
fn is_right(stage: &mut Stage, scene: &GpuScene, right: &GpuScene) {
    let mut oracle = Oracle::new(right, SIZE);
    for number in 0..4 {
        let camera = camera(number * 7, 7.0);
        let verdicts = frame(stage, scene, &[camera]).remove(0);
        let wrong = wrong_pixels_percent(&mut oracle, right, &camera, &verdicts);
        assert_eq!(wrong, 0.0, "frame {number}");
    }
}

#[test]
fn what_relies_on_a_wrong_capability_is_replaced_by_frustum() {
    let cases: [(Fault, String, Capability); 8] = [
        (LOST_COUNTS, exact("atomics"), Capability::FragmentAtomics),
        (LOST_FIND, "depth-pyramid".to_owned(), Capability::BoxTest),
        (
            STALE_LEVEL,
            "depth-pyramid".to_owned(),
            Capability::DepthPyramid,
        ),
        (
            ZEROED_BOX_QUERY,
            "occupancy-map:latency=same-frame".to_owned(),
            Capability::OcclusionQueries,
        ),
        (
            ZEROED_MESH_QUERY,
            exact("queries"),
            Capability::OcclusionQueries,
        ),
        (
            LOST_SLOT,
            "depth-pyramid".to_owned(),
            Capability::Compaction,
        ),
        (
            LOST_DRAW,
            "three-pass:latency=on-gpu".to_owned(),
            Capability::Compaction,
        ),
        (
            LOST_HISTOGRAM,
            "coherent:latency=on-gpu".to_owned(),
            Capability::IdHistogram,
        ),
    ];
    for gpu in gpus() {
        let right = scene_on(gpu);
        for (fault, strategy, broken) in &cases {
            let at = format!("{strategy} with {} on {}", fault.name, gpu.title());
            let scene = scene_on(&fault.on(gpu));
            let mut stage = made(&scene, strategy, DistrustOptions::default());
            assert_eq!(stage.strategy().name(), "frustum", "{at}");
            let says = stage.distrust().iter().any(|found| {
                let named = matches!(&found.cause, DistrustCause::SelfTest { capability, .. } if capability == broken);
                named && found.instead == Instead::Frustum && strategy.starts_with(&found.strategy)
            });
            assert!(says, "{at}: {:?}", stage.distrust());
            let report = stage.self_test().unwrap();
            assert!(
                report.failures().any(|(failed, _)| failed == *broken),
                "{at}"
            );
            is_right(&mut stage, &scene, &right);
        }
    }
}

#[test]
fn a_wrong_way_of_counting_is_replaced_by_a_proven_one() {
    let cases = [
        (LOST_COUNT, exact("atomics"), Counting::Compare),
        (LOST_HISTOGRAM, exact("identity"), Counting::Atomics),
        (LOST_HISTOGRAM, exact("auto"), Counting::Atomics),
        (ZEROED_BOX_QUERY, exact("queries"), Counting::Atomics),
    ];
    for gpu in gpus() {
        let right = scene_on(gpu);
        for (fault, strategy, instead) in &cases {
            let at = format!("{strategy} with {} on {}", fault.name, gpu.title());
            let scene = scene_on(&fault.on(gpu));
            let mut stage = made(&scene, strategy, DistrustOptions::default());
            assert_eq!(stage.strategy().name(), "three-pass", "{at}");
            let [found] = stage.distrust() else {
                panic!("{at}: {:?}", stage.distrust());
            };
            assert_eq!(found.instead, Instead::Counting(*instead), "{at}");
            assert!(found.to_string().contains("counts by"), "{found}");
            is_right(&mut stage, &scene, &right);
        }
    }
}

#[test]
fn what_does_not_rely_on_it_stays_and_so_does_what_believes_the_driver() {
    for gpu in gpus() {
        let scene = scene_on(&LOST_DRAW.on(gpu));
        let stage = made(&scene, &exact("identity"), DistrustOptions::default());
        assert_eq!(stage.strategy().name(), "three-pass");
        assert_eq!(stage.distrust(), []);
        let stage = made(&scene, "depth-pyramid", DistrustOptions::OFF);
        assert_eq!(stage.strategy().name(), "depth-pyramid");
        assert_eq!(stage.distrust(), []);
        assert_eq!(stage.self_test(), None);
        // A yardstick relies on nothing.
        let stage = made(&scene, "frustum", DistrustOptions::default());
        assert_eq!(stage.self_test(), None);
    }
}

#[test]
fn a_stage_in_a_hosts_frame_falls_back_too() {
    for gpu in gpus() {
        let scene = scene_on(&LOST_FIND.on(gpu));
        let options = StageOptions {
            mode: Mode::Embedded,
            ..StageOptions::default()
        };
        let strategy = registry().parse("depth-pyramid").unwrap();
        let stage = stage_with(&scene, strategy, views(&["main"], SIZE), options);
        assert_eq!(stage.strategy().name(), "frustum");
    }
}
