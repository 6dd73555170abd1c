//! Scenes that move by themselves: boxes hold for each pose, no conservative strategy misses anything in any frame, and a comparison plays the same times to all.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod animated;

use antumbra_cull::{Stage, Verdict, ViewInput};
use antumbra_draw::GpuScene;
use antumbra_formats::{LoadOptions, SceneFormat, load_slice_with_attachments};
use antumbra_measure::compare::{CompareOptions, Contender, Playback, Timing, compare_scripted};
use antumbra_measure::path::CameraPath;
use antumbra_scene::{Aabb, Camera, EntityKey, Scene};
use antumbra_strategies::registry;
use antumbra_testing::{gpus, look_at, perspective, stage, views};
use antumbra_verify::{EntitySet, Oracle};
use glam::{DVec3, Vec3};

const SIZE: [u32; 2] = [160, 120];
const FRAMES: usize = 24;

/// Strategies that decide on the frame that they draw, and promise to miss nothing.
const CONSERVATIVE: [&str; 5] = [
    "depth-pyramid",
    "frustum",
    "chc-plus-plus:latency=same-frame",
    "occupancy-map:latency=same-frame",
    "coherent:latency=on-gpu",
];

fn camera() -> Camera {
    look_at(DVec3::Z * 14.0, DVec3::ZERO, perspective(0.8, 0.1))
}

/// The scene, and its clip at a steady rate over the frames.
fn moving() -> (Scene, Playback) {
    let options = LoadOptions::default();
    let file = animated::file();
    let loaded =
        load_slice_with_attachments(SceneFormat::Gltf, &file, None, &options, &[]).unwrap();
    assert!(loaded.left_out.is_empty(), "{}", loaded.left_out);
    let timing = Timing {
        start: 0.0,
        frames_per_second: Some(FRAMES as f64 / animated::SECONDS),
    };
    let playback = Playback::new(loaded.animation.unwrap(), 0, timing).unwrap();
    (loaded.scene, playback)
}

fn named(scene: &Scene, name: &str) -> EntityKey {
    let mut entities = scene.entities();
    entities
        .find(|entity| scene.entity_name(*entity) == name)
        .unwrap()
}

#[test]
fn boxes_hold_the_vertices_of_every_pose() {
    let (mut scene, playback) = moving();
    scene.ensure_proxies(&Default::default());
    scene.update();
    let at_rest: Vec<Option<Aabb>> = ["carried", "arm", "gate", "swelling"]
        .map(|name| scene.world_bounds(named(&scene, name)))
        .to_vec();
    let mut left_rest = [false; 4];
    for frame in 0..FRAMES {
        playback.show(&mut scene, frame).unwrap();
        scene.update();
        for (number, name) in ["carried", "arm", "gate", "swelling"].iter().enumerate() {
            let entity = named(&scene, name);
            let bounds = scene.world_bounds(entity).unwrap();
            let mesh = scene.mesh(scene.drawable(entity).unwrap().mesh).unwrap();
            let world = scene.world(entity).unwrap();
            for position in &mesh.full().unwrap().positions {
                let point = world.transform_point3(Vec3::from(*position).as_dvec3());
                let inside = point.cmpge(bounds.min - 1e-9) & point.cmple(bounds.max + 1e-9);
                assert!(
                    inside.all(),
                    "{name} in frame {frame}: {point} in {bounds:?}"
                );
            }
            let rest = at_rest[number].unwrap();
            left_rest[number] |= (bounds.max.cmpgt(rest.max + 1.0)).any();
        }
    }
    assert_eq!(left_rest, [true; 4], "boxes at rest would be wrong");
}

/// What the frames of a strategy showed.
#[derive(Default)]
struct Shown {
    occluded: usize,
    moving_drawn: [bool; 4],
    moving_culled: [bool; 4],
}

#[test]
fn no_conservative_strategy_misses_anything_while_things_move() {
    for gpu in gpus() {
        let (mut host, playback) = moving();
        host.ensure_proxies(&Default::default());
        let mut scene = GpuScene::new(gpu, &mut host).unwrap();
        let names = ["carried", "arm", "gate", "swelling"].map(|name| named(&host, name));
        let mut stages: Vec<(&str, Stage, Shown)> = CONSERVATIVE
            .map(|text| {
                (
                    text,
                    stage(&scene, text, views(&["main"], SIZE)),
                    Shown::default(),
                )
            })
            .into();
        let mut oracle = Oracle::new(&scene, SIZE);
        for frame in 0..FRAMES {
            playback.show(&mut host, frame).unwrap();
            if frame % 2 == 0 {
                scene.sync(&mut host).unwrap();
            } else {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                scene.sync_in(&mut host, &mut encoder).unwrap();
                gpu.queue.submit([encoder.finish()]);
            }
            // All there is: a reference of what is in the frustum would believe the boxes.
            let all: Vec<u32> = scene.table().live_slots().collect();
            let camera = camera();
            let reference = oracle
                .render(&scene, &camera, EntitySet::Slots(&all))
                .unwrap();
            for (text, stage, shown) in &mut stages {
                stage.frame(&scene, &[ViewInput::new(camera)]).unwrap();
                gpu.wait().unwrap();
                let verdicts = stage.verdicts(0, &scene).unwrap();
                let mut missed = reference.owners();
                missed.retain(|slot| !verdicts.get(*slot).draws());
                let place = format!("{text}, frame {frame}, {}", gpu.info.backend);
                let name = |slot: &u32| {
                    let key = scene.table().occupant(*slot).unwrap().key;
                    host.entity_name(key).to_owned()
                };
                let names_of: Vec<String> = missed.iter().map(name).collect();
                assert!(missed.is_empty(), "{place}: missed {names_of:?}");
                let drawn = EntitySet::Drawn(&verdicts);
                let drawn = oracle.render(&scene, &camera, drawn).unwrap();
                assert_eq!(reference.wrong_pixels(&drawn), 0, "{place}");
                for (number, key) in names.iter().enumerate() {
                    let draws = verdicts.get(scene.slot(*key).unwrap()).draws();
                    shown.moving_drawn[number] |= draws;
                    shown.moving_culled[number] |= !draws;
                }
                let occluded = all
                    .iter()
                    .filter(|slot| verdicts.get(**slot) == Verdict::Occluded);
                shown.occluded += occluded.count();
            }
        }
        for (text, _, shown) in &stages {
            assert_eq!(
                shown.moving_drawn, [true; 4],
                "{text}: each comes into view"
            );
            if *text != "frustum" {
                assert!(shown.occluded > FRAMES * 10, "{text}: {}", shown.occluded);
                assert_eq!(shown.moving_culled, [true; 4], "{text}: each is hidden");
            }
        }
    }
}

#[test]
fn a_comparison_plays_the_same_times_to_all() {
    let (mut scene, mut playback) = moving();
    scene.ensure_proxies(&Default::default());
    let pose = antumbra_measure::path::Pose {
        position: camera().position,
        rotation: camera().rotation,
        cut: false,
    };
    let path = CameraPath::new("still", camera().projection, vec![pose; 8]).unwrap();
    let registry = std::sync::Arc::new(registry());
    let contender = |text: &str| Contender::of("", &registry, text).unwrap();
    let contenders = ["ideal", "frustum", "depth-pyramid"].map(contender);
    let options = CompareOptions {
        size: SIZE,
        least_seconds: 0.0,
        motion: Some(playback.facts()),
        ..CompareOptions::default()
    };
    let compared = compare_scripted(
        antumbra_testing::vulkan(),
        &mut scene,
        &mut playback,
        &path,
        &contenders,
        &options,
        &mut |_| {},
    )
    .unwrap();
    for strategy in &compared.report.strategies {
        assert_eq!(
            strategy.error.false_culls,
            Default::default(),
            "{}",
            strategy.name
        );
    }
    let motion = compared.report.scene.motion.as_ref().unwrap();
    assert_eq!((motion.name.as_str(), motion.seconds), ("all", 2.0));
    let [scene, _] = antumbra_measure::table::facts(&compared.report);
    let words = "animation all from 0 s on, 12 frames a second of it, again after 2 s";
    assert!(scene.contains(words), "{scene}");
}
