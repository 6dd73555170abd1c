//! The plans that strategies compile to: their sync points, their edges to the previous frame, and the passes they do not have.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Stage, ViewInput};
use antumbra_draw::GpuScene;
use antumbra_graph::PlanFormat;
use antumbra_scene::{Camera, Drawable, Scene};
use antumbra_testing::{add, balls, glass, look_at, perspective, vulkan};
use glam::{DAffine3, DVec3};

const LATE: &str = "three-pass:latency=frame-late";
const NOW: &str = "three-pass:latency=same-frame";
const ON_GPU: &str = "three-pass:latency=on-gpu";

fn small_grid() -> Scene {
    balls(3)
}

/// The built-in grid with a transparent sphere in front of it.
fn glazed_grid() -> Scene {
    let mut scene = small_grid();
    let (_, drawable) = scene.drawables().next().unwrap();
    let material = scene.add_material(glass([1.0; 4]));
    let mesh = drawable.mesh;
    let place = DAffine3::from_translation(DVec3::Z * 3.0);
    add(&mut scene, place, Drawable { mesh, material });
    scene
}

fn stage(scene: &GpuScene, text: &str, views: &[&str]) -> Stage {
    antumbra_testing::stage(scene, text, antumbra_testing::views(views, [64, 48]))
}

fn camera() -> Camera {
    look_at(
        DVec3::new(4.0, 2.0, 6.0),
        DVec3::ZERO,
        perspective(1.0, 0.1),
    )
}

/// Names of the passes that run.
fn passes(stage: &Stage) -> Vec<String> {
    stage
        .plan()
        .passes()
        .iter()
        .map(|pass| pass.name.to_owned())
        .collect()
}

#[test]
fn each_latency_waits_as_often_as_it_says() {
    let gpu = vulkan();
    for mut scene in [small_grid(), glazed_grid()] {
        let scene = GpuScene::new(gpu, &mut scene).unwrap();
        for way in ["queries", "atomics", "compare", "identity"] {
            for (latency, waits) in [(LATE, 0), (NOW, 1), (ON_GPU, 0)] {
                for views in [&["main"][..], &["left", "right"]] {
                    let text = format!("{latency}:counting={way}:threshold=0");
                    let mut stage = stage(&scene, &text, views);
                    assert_eq!(stage.plan().sync_points(), waits, "{text} {views:?}");
                    let inputs = vec![ViewInput::new(camera()); views.len()];
                    for _ in 0..2 {
                        let report = stage.frame(&scene, &inputs).unwrap();
                        assert_eq!(report.plan.sync_points as usize, waits, "{text} {views:?}");
                        assert_eq!(report.plan.skipped_read_backs, 0, "{text} {views:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn stop_and_wait_waits_for_every_batch_and_once_more_to_find_the_end() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut small_grid()).unwrap();
    for (batch, turns) in [(1, 28), (9, 4), (10, 4), (27, 2), (4096, 2)] {
        let mut stage = stage(&scene, &format!("stop-and-wait:batch={batch}"), &["main"]);
        let [looped] = stage.plan().loop_sync_points()[..] else {
            panic!("one host loop");
        };
        assert_eq!((looped.name, looped.sync_points), ("stop and wait", 1));
        let report = stage.frame(&scene, &[ViewInput::new(camera())]).unwrap();
        assert_eq!(
            (report.plan.loop_iterations, report.plan.sync_points),
            (turns, turns),
            "batch {batch}"
        );
        let verdicts = stage.verdicts(0, &scene).unwrap();
        assert_eq!(verdicts.tested(), 27);
    }
}

#[test]
fn the_picture_shows_what_looks_back_and_what_waits() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut small_grid()).unwrap();
    for (text, looks_back, waits) in [
        (LATE, true, false),
        (NOW, false, true),
        (ON_GPU, false, false),
        ("frustum", false, false),
    ] {
        let stage = stage(&scene, text, &["main"]);
        let dot = stage.plan().export(PlanFormat::Dot);
        assert_eq!(dot.contains("style=dashed"), looks_back, "{text}:\n{dot}");
        let json: String = stage
            .plan()
            .export(PlanFormat::Json)
            .split_whitespace()
            .collect();
        assert_eq!(
            json.contains("\"history\":true"),
            looks_back,
            "{text}:\n{json}"
        );
        assert_eq!(
            json.contains("\"sync_point\":true"),
            waits,
            "{text}:\n{json}"
        );
        assert_eq!(
            json.contains("\"sync_points\":0"),
            !waits,
            "{text}:\n{json}"
        );
    }
}

#[test]
fn baselines_ask_and_count_nothing() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut small_grid()).unwrap();
    for text in ["none", "frustum"] {
        let stage = stage(&scene, text, &["main"]);
        let words = [
            "quer",
            "count",
            "histogram",
            "ids",
            "proxies",
            "depth",
            "transparent",
            "read",
        ];
        for pass in passes(&stage) {
            assert!(
                !words.iter().any(|word| pass.contains(word)),
                "{text} has '{pass}'"
            );
        }
        let raster = stage.plan().passes();
        let drawing = raster.iter().filter(|pass| pass.group == Some("draw"));
        assert_eq!(drawing.count(), 1, "{text}: {raster:?}");
    }
}

#[test]
fn transparency_is_there_for_as_long_as_something_is_transparent() {
    let gpu = vulkan();
    let mut scene = glazed_grid();
    let glass = scene.drawables().last().unwrap().0;
    let mut gpu_scene = GpuScene::new(gpu, &mut scene).unwrap();
    for text in ["none", "frustum", "stop-and-wait", LATE, NOW, ON_GPU] {
        let stage = stage(&gpu_scene, text, &["main"]);
        let all = passes(&stage);
        assert!(
            all.iter().any(|pass| pass == "transparent"),
            "{text}: {all:?}"
        );
    }
    let mut running = stage(&gpu_scene, "frustum", &["main"]);
    scene.despawn(glass);
    gpu_scene.sync(&mut scene).unwrap();
    running
        .frame(&gpu_scene, &[ViewInput::new(camera())])
        .unwrap();
    assert!(!passes(&running).iter().any(|pass| pass == "transparent"));
    for text in ["none", "stop-and-wait", LATE, NOW, ON_GPU] {
        let stage = stage(&gpu_scene, text, &["main"]);
        let all = passes(&stage);
        assert!(
            !all.iter().any(|pass| pass.contains("transparent")),
            "{text}: {all:?}"
        );
    }
}

#[test]
fn a_second_eye_is_there_when_it_is_asked_for() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut small_grid()).unwrap();
    let one = passes(&stage(&scene, NOW, &["main"]));
    assert!(
        one.iter()
            .all(|pass| !pass.contains("left") && !pass.contains("right"))
    );
    let two = passes(&stage(&scene, NOW, &["left", "right"]));
    assert_eq!(two.len(), one.len() * 2);
    let of = |eye: &str| two.iter().filter(|pass| pass.starts_with(eye)).count();
    assert_eq!(
        (of("left: "), of("right: ")),
        (one.len(), one.len()),
        "{two:?}"
    );
}

#[test]
fn a_threshold_is_turned_on_the_gpu_and_nothing_read_back_for_it() {
    let scene = GpuScene::new(vulkan(), &mut small_grid()).unwrap();
    let turns = |text: &str| {
        let all = passes(&stage(&scene, text, &["main"]));
        ["submit tested slots", "adapt threshold"]
            .map(|name| all.iter().filter(|pass| *pass == name).count())
    };
    assert_eq!(turns(ON_GPU), [0, 0]);
    assert_eq!(turns("three-pass:latency=on-gpu:allow=0.1"), [1, 1]);
    assert_eq!(turns("three-pass:latency=same-frame:allow=0.1"), [0, 0]);
    let allowing = stage(&scene, "three-pass:latency=on-gpu:allow=0.1", &["main"]);
    assert_eq!(allowing.plan().sync_points(), 0);
    let picture = allowing.plan().export(PlanFormat::Dot);
    assert!(!picture.contains("style=dashed"), "{picture}");
}
