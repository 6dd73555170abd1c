//! Reversed time: paths flown back, scenes that return to an earlier state, and answers about another scene.
//!
//! That answers arrive in the order of frames is tested with the graph: `crates/graph/tests/gpu/late.rs`.

use antumbra::cull::{Gpu, Stage, StageOptions, StageScene, Verdicts, ViewInput, ViewSpec};
use antumbra::draw::GpuScene;
use antumbra::scene::Camera;
use antumbra::verify::{EntitySet, Oracle};
use antumbra_testing::{SceneBuilder, gpus, look_at, perspective_degrees, placed};
use glam::DVec3;

use crate::play::{Play, made, strategies};

/// Frame-late strategies whose only error is their latency.
const LATE: [&str; 5] = [
    "three-pass:latency=frame-late:threshold=0:scale=1:coarser=0:occluders=full:occludees=full",
    "coherent:latency=frame-late",
    "stereo-coherent:latency=frame-late",
    "occupancy-map:latency=frame-late",
    "chc-plus-plus:latency=frame-late",
];

fn late_and_exact() -> Vec<String> {
    let late = LATE.map(str::to_owned);
    late.into_iter().chain(strategies()).collect()
}

fn camera(x: f64) -> Camera {
    let eye = DVec3::new(x, 0.5, 6.0);
    look_at(
        eye,
        DVec3::new(x * 0.5, 0.25, 0.0),
        perspective_degrees(60.0, 0.125),
    )
}

/// A stage with one view, run frame by frame.
struct Run<'a> {
    gpu: &'a Gpu,
    stage: Stage,
    needs_reference: bool,
}

impl<'a> Run<'a> {
    fn new(gpu: &'a Gpu, scene: &GpuScene, text: &str) -> Self {
        let views = vec![ViewSpec::main(64, 48)];
        let strategy = made(text);
        Self {
            gpu,
            needs_reference: strategy.needs_reference(),
            stage: Stage::new(scene, strategy, views, StageOptions::default()).unwrap(),
        }
    }

    /// Runs a frame. Returns the slots that own a pixel and are not drawn, and the verdicts. Answers have arrived before the next frame reads
    /// them.
    fn frame(&mut self, scene: &GpuScene, camera: Camera) -> (Vec<u32>, Verdicts) {
        let mut oracle = Oracle::new(scene, [64, 48]);
        let owners = oracle
            .render(scene, &camera, EntitySet::InFrustum)
            .unwrap()
            .owners();
        assert!(owners.len() > 5);
        let mut input = ViewInput::new(camera);
        input.reference = self.needs_reference.then(|| owners.clone().into());
        self.stage.frame(scene, &[input]).unwrap();
        self.gpu.wait().unwrap();
        let verdicts = self.stage.verdicts(0, scene).unwrap();
        let missed = owners
            .into_iter()
            .filter(|slot| !verdicts.get(*slot).draws());
        (missed.collect(), verdicts)
    }
}

#[test]
fn a_path_flown_back_is_seen_as_it_was_flown() {
    let there: Vec<Camera> = (0..5).map(|i| camera(f64::from(i) * 0.75 - 1.5)).collect();
    let back = there.iter().rev().copied();
    let frames: Vec<Camera> = there.iter().copied().chain(back).collect();
    let set = SceneBuilder::still_life(1.0, DVec3::ZERO);
    let play = Play {
        apart: 0.0625,
        ..Play::new(set.scene, frames)
    };
    for (strategy, frames) in play.is_right() {
        // A strategy with memory may draw more on the way back; others give the same verdicts at the same pose.
        let remembers = [
            "coherent",
            "occupancy-map",
            "chc-plus-plus",
            "depth-pyramid",
        ];
        if remembers.iter().any(|name| strategy.contains(name)) {
            continue;
        }
        let (there, back) = frames.split_at(5);
        for (pose, (there, back)) in there.iter().zip(back.iter().rev()).enumerate() {
            assert!(there[0].agree(&back[0]), "{strategy}: pose {pose}");
        }
    }
    // Late answers cover new entities on the way back as well (the kit checks this), and settle.
    let still = std::iter::repeat_n(camera(-1.5), 5);
    let frames = play.frames.iter().copied().chain(still).collect();
    let play = Play { frames, ..play };
    let [gpu, _] = gpus();
    let (_, images) = play.seen(gpu);
    let owners = images[images.len() - 1].owners();
    for (strategy, frames) in play.is_right_by(&LATE.map(str::to_owned)) {
        let last = &frames[frames.len() - 1][0];
        assert!(
            owners.iter().all(|slot| last.get(*slot).draws()),
            "{strategy}"
        );
    }
}

#[test]
fn a_scene_that_returns_to_what_it_was_is_no_past_state() {
    let [gpu, _] = gpus();
    for text in late_and_exact()
        .iter()
        .filter(|text| !text.contains("stereo"))
    {
        let late = LATE.contains(&text.as_str());
        let mut set = SceneBuilder::still_life(1.0, DVec3::ZERO);
        let hidden = placed(DVec3::new(0.0, -0.5, -1.0), DVec3::splat(0.5));
        let in_sight = placed(DVec3::new(0.0, -0.5, 1.5), DVec3::splat(0.5));
        let moves = set.put(set.cube, hidden);
        let mut scene = GpuScene::new(gpu, &mut set.scene).unwrap();
        let mut run = Run::new(gpu, &scene, text);
        let mut epoch = scene.table().epoch();
        // The cube is hidden, removed, added again (another key, the same slot) where it is visible, and hidden again. Its epoch never returns.
        let mut here = moves;
        for step in 0..6 {
            let (missed, _) = run.frame(&scene, camera(0.0));
            assert!(late || missed.is_empty(), "{text}, step {step}: {missed:?}");
            let slot = scene.slot(here).unwrap();
            if step % 2 == 0 {
                set.scene.despawn(here);
                here = set.put(set.cube, in_sight);
                scene.sync(&mut set.scene).unwrap();
                assert_eq!(scene.slot(here), Some(slot), "{text}: the slot is free");
                let (missed, _) = run.frame(&scene, camera(0.0));
                assert!(
                    missed.is_empty(),
                    "{text}, step {step}: an answer about the removed entity is used"
                );
            } else {
                set.scene.set_local(here, hidden).unwrap();
                scene.sync(&mut set.scene).unwrap();
            }
            assert!(scene.table().epoch() > epoch);
            epoch = scene.table().epoch();
        }
    }
}

#[test]
fn answers_about_another_scene_are_not_applied() {
    let [vulkan, gl] = gpus();
    for gpu in [vulkan, gl] {
        // Both scenes have the same slots; the entities hidden in one are visible in the other.
        let mut sets = [1.0, -1.0].map(|front| {
            let mut set = SceneBuilder::still_life(1.0, DVec3::ZERO);
            for column in -2..=2 {
                let place = DVec3::new(f64::from(column), -1.0, -1.5 * front);
                set.cube(place, DVec3::splat(0.5));
            }
            set
        });
        let [mut first, mut second] = sets
            .each_mut()
            .map(|set| GpuScene::new(gpu, &mut set.scene).unwrap());
        // The first scene has a later epoch: answers about the second are older than it, and those about the first are newer than the second.
        for _ in 0..5 {
            let moved = sets[0].ball(DVec3::new(0.0, 0.0, -9.0), 0.5);
            first.sync(&mut sets[0].scene).unwrap();
            sets[0].scene.despawn(moved);
            first.sync(&mut sets[0].scene).unwrap();
        }
        second.sync(&mut sets[1].scene).unwrap();
        assert!(first.table().epoch() > second.table().epoch());
        assert_eq!(first.layout(), second.layout());
        for text in late_and_exact()
            .iter()
            .filter(|text| !text.contains("stereo"))
        {
            let mut run = Run::new(gpu, &first, text);
            for (turn, scene) in [&first, &first, &second, &first, &second, &second, &first]
                .into_iter()
                .enumerate()
            {
                let (missed, _) = run.frame(scene, camera(0.0));
                assert!(
                    missed.is_empty(),
                    "{}, {text}, frame {turn}: {missed:?}",
                    gpu.title()
                );
            }
        }
    }
}
