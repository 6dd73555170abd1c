//! A scene that outgrows its buffers and a view that is resized get a new plan. What a strategy knows stays, and the report says that there is a new plan.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Rebuilt, Stage, ViewInput};
use antumbra_draw::GpuScene;
use antumbra_scene::{Camera, Scene};
use antumbra_testing::{add, balls_with_proxies, gpus, look_at, perspective, stage, views};
use antumbra_verify::{EntitySet, Oracle};
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [160, 120];

/// Strategies that remember on the host: by counts, by queries, and down a tree that follows the scene's own groups.
const STRATEGIES: [&str; 4] = [
    "three-pass:latency=frame-late:threshold=0:occluders=full:occludees=full:scale=1",
    "coherent:latency=frame-late",
    "coherent:latency=same-frame",
    "occupancy-map:latency=frame-late:worth=0:grain=0",
];

fn camera() -> Camera {
    let eye = DVec3::new(9.0, 3.0, 12.0);
    look_at(eye, DVec3::ZERO, perspective(0.9, 0.05))
}

/// What a frame drew, and why it had another plan.
#[derive(Debug)]
struct Frame {
    drawn: Vec<u32>,
    rebuilt: Option<Rebuilt>,
}

fn frame(stage: &mut Stage, scene: &GpuScene) -> Frame {
    let report = stage.frame(scene, &[ViewInput::new(camera())]).unwrap();
    scene.gpu().wait().unwrap();
    Frame {
        drawn: stage.verdicts(0, scene).unwrap().drawn().collect(),
        rebuilt: report.rebuilt,
    }
}

fn settle(stage: &mut Stage, scene: &GpuScene) -> Frame {
    let mut last = frame(stage, scene);
    for _ in 0..12 {
        last = frame(stage, scene);
        assert_eq!(last.rebuilt, None);
    }
    last
}

fn stage_of(text: &str, scene: &GpuScene, size: [u32; 2]) -> Stage {
    stage(scene, text, views(&["main"], size))
}

fn owners(scene: &GpuScene, size: [u32; 2]) -> Vec<u32> {
    let mut oracle = Oracle::new(scene, size);
    let image = oracle.render(scene, &camera(), EntitySet::InFrustum);
    image.unwrap().owners()
}

/// Adds balls behind the camera until the scene's buffers are outgrown.
fn outgrow(host: &mut Scene, scene: &mut GpuScene) {
    use antumbra_cull::StageScene;
    let drawable = host.drawables().next().unwrap().1;

    let before = scene.layout();
    let mut added = 0u32;
    while scene.layout() == before {
        for _ in 0..64 {
            let away = DVec3::new(30.0 + f64::from(added), 10.0, 40.0);
            add(host, DAffine3::from_translation(away), drawable);
            added += 1;
        }
        scene.sync(host).unwrap();
    }
}

#[test]
fn growth_keeps_what_strategies_know() {
    for gpu in gpus() {
        for text in STRATEGIES {
            let mut host = balls_with_proxies(8);
            let mut scene = GpuScene::new(gpu, &mut host).unwrap();
            let mut stage = stage_of(text, &scene, SIZE);
            let all = frame(&mut stage, &scene).drawn.len();
            let settled = settle(&mut stage, &scene).drawn.len();
            assert!(settled * 4 < all * 3, "{text}: {settled} of {all}");
            outgrow(&mut host, &mut scene);
            let after = frame(&mut stage, &scene);
            assert_eq!(after.rebuilt, Some(Rebuilt::Layout), "{text}");
            // A tree may be divided anew over what was added; what is known of entities is not lost by it.
            let most = settled + settled / 4;
            assert!(
                after.drawn.len() <= most,
                "{text}: {} after {settled}, of {all}",
                after.drawn.len()
            );
            let seen = owners(&scene, SIZE);
            for now in [&after, &settle(&mut stage, &scene)] {
                let missing: Vec<&u32> = seen
                    .iter()
                    .filter(|slot| !now.drawn.contains(slot))
                    .collect();
                assert!(missing.is_empty(), "{text}: {missing:?} are visible");
                assert!(now.drawn.len() <= most, "{text}: {}", now.drawn.len());
            }
        }
    }
}

#[test]
fn a_resize_keeps_what_strategies_know() {
    for gpu in gpus() {
        for text in STRATEGIES {
            let mut host = balls_with_proxies(8);
            let scene = GpuScene::new(gpu, &mut host).unwrap();
            let mut stage = stage_of(text, &scene, SIZE);
            let all = frame(&mut stage, &scene).drawn.len();
            let settled = settle(&mut stage, &scene).drawn.len();
            stage.resize(0, SIZE).unwrap();
            assert_eq!(frame(&mut stage, &scene).rebuilt, None, "the same size");
            for size in [[240, 180], [80, 60]] {
                stage.resize(0, size).unwrap();
                let after = frame(&mut stage, &scene);
                assert_eq!(after.rebuilt, Some(Rebuilt::Size), "{text}");
                let image = stage.colour(0).unwrap();
                assert_eq!([image.width(), image.height()], size);
                // What a stage that starts at this size comes to.
                let mut fresh = stage_of(text, &scene, size);
                let first = frame(&mut fresh, &scene).drawn.len();
                let fresh = settle(&mut fresh, &scene).drawn.len();
                let most = settled.max(fresh) + all / 16;
                assert!(
                    first == all && most < all,
                    "{text}: {fresh} of {all} at {size:?}"
                );
                // Other pixels show other entities, and entities that share a query come with them, until their next answers.
                assert!(after.drawn.len() < all, "{text} at {size:?}");
                let next = [0; 3].map(|_| frame(&mut stage, &scene).drawn.len())[2];
                assert!(
                    next <= most,
                    "{text}: {next} after {settled}, {fresh} at {size:?}, of {all}"
                );
                // An answer of another size may miss what shows at this one, for as long as answers are late.
                let now = settle(&mut stage, &scene);
                let seen = owners(&scene, size);
                let missing: Vec<&u32> = seen
                    .iter()
                    .filter(|slot| !now.drawn.contains(slot))
                    .collect();
                assert!(missing.is_empty(), "{text}: {missing:?} are visible");
            }
        }
    }
}

#[test]
fn sizes_and_views_that_cannot_be_are_refused() {
    let mut host = balls_with_proxies(2);
    let scene = GpuScene::new(gpus()[0], &mut host).unwrap();
    let mut stage = stage_of("frustum", &scene, SIZE);
    for (view, size, word) in [
        (1, [64, 64], "view 1"),
        (0, [0, 64], "each side"),
        (0, [64, u32::MAX], "each side"),
    ] {
        let error = stage.resize(view, size).unwrap_err().to_string();
        assert!(error.contains(word), "{error}");
    }
    // Nothing has changed.
    assert_eq!(frame(&mut stage, &scene).rebuilt, None);
}

#[test]
fn counts_of_another_size_say_only_whether_anything_was_visible() {
    let mut host = balls_with_proxies(8);
    let scene = GpuScene::new(gpus()[0], &mut host).unwrap();
    for text in [
        "three-pass:latency=frame-late:threshold=60:scale=1",
        "three-pass:latency=frame-late:threshold=0:allow=20:scale=1",
    ] {
        let mut stage = stage_of(text, &scene, [80, 60]);
        let settled = settle(&mut stage, &scene).drawn.len();
        let exact = "three-pass:latency=frame-late:threshold=0:scale=1";
        let visible = settle(&mut stage_of(exact, &scene, [80, 60]), &scene);
        assert!(settled < visible.drawn.len(), "{text} leaves nothing out");
        stage.resize(0, [320, 240]).unwrap();
        let after = frame(&mut stage, &scene).drawn;
        assert_eq!(after, visible.drawn, "{text}");
    }
}

#[test]
fn a_view_that_is_resized_every_frame_culls_nothing_that_is_visible() {
    for text in STRATEGIES {
        let mut host = balls_with_proxies(6);
        let scene = GpuScene::new(gpus()[0], &mut host).unwrap();
        let mut stage = stage_of(text, &scene, SIZE);
        settle(&mut stage, &scene);
        for step in 0..10u32 {
            let size = [SIZE[0] + step * 4 + 4, SIZE[1] + step * 3 + 3];
            stage.resize(0, size).unwrap();
            let angle = f64::from(step) * 0.3;
            let eye = DVec3::new(angle.sin(), 0.3, angle.cos()) * 12.0;
            let camera = look_at(eye, DVec3::ZERO, perspective(0.9, 0.05));
            stage.frame(&scene, &[ViewInput::new(camera)]).unwrap();
            scene.gpu().wait().unwrap();
            let drawn: Vec<u32> = stage.verdicts(0, &scene).unwrap().drawn().collect();
            let mut oracle = Oracle::new(&scene, size);
            let seen = oracle.render(&scene, &camera, EntitySet::InFrustum);
            let missing = seen.unwrap().owners();
            let missing = missing.iter().filter(|slot| !drawn.contains(slot)).count();
            // In the first frame the answers are as late as ever.
            assert!(step == 0 || missing == 0, "{text}, step {step}: {missing}");
        }
    }
}

#[test]
fn a_failed_frame_keeps_the_report_of_a_new_plan() {
    let mut host = balls_with_proxies(2);
    let scene = GpuScene::new(gpus()[0], &mut host).unwrap();
    let mut stage = stage_of("frustum", &scene, SIZE);
    frame(&mut stage, &scene);
    stage.resize(0, [64, 64]).unwrap();
    let mut broken = camera();
    broken.position.x = f64::NAN;
    assert!(stage.frame(&scene, &[ViewInput::new(broken)]).is_err());
    assert_eq!(frame(&mut stage, &scene).rebuilt, Some(Rebuilt::Size));
    // There and back is no change.
    stage.resize(0, [96, 96]).unwrap();
    stage.resize(0, [64, 64]).unwrap();
    assert_eq!(frame(&mut stage, &scene).rebuilt, None);
    let mut other = balls_with_proxies(3);
    let other = GpuScene::new(gpus()[0], &mut other).unwrap();
    assert_eq!(frame(&mut stage, &other).rebuilt, Some(Rebuilt::Scene));
    let elsewhere = GpuScene::new(gpus()[1], &mut balls_with_proxies(2)).unwrap();
    let error = stage.frame(&elsewhere, &[ViewInput::new(camera())]);
    assert!(error.unwrap_err().to_string().contains("another device"));
}

#[test]
fn what_lies_on_the_gpu_is_lost_for_one_frame_and_no_pixel_with_it() {
    for gpu in gpus() {
        let mut host = balls_with_proxies(8);
        let mut scene = GpuScene::new(gpu, &mut host).unwrap();
        let mut stage = stage_of("coherent:latency=on-gpu", &scene, SIZE);
        let all = frame(&mut stage, &scene).drawn.len();
        let settled = settle(&mut stage, &scene).drawn.len();
        assert!(settled < all);
        outgrow(&mut host, &mut scene);
        // Nothing was seen by the new buffers' account, so nothing hides anything.
        let after = frame(&mut stage, &scene);
        assert_eq!(
            (after.rebuilt, after.drawn.len()),
            (Some(Rebuilt::Layout), all)
        );
        let now = settle(&mut stage, &scene).drawn;
        assert_eq!(now.len(), settled);
        assert!(owners(&scene, SIZE).iter().all(|slot| now.contains(slot)));
    }
}
