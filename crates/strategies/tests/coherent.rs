//! The coherent strategies: the second view needs fewer queries, a fraction delays an entity by a bounded number of frames, and nothing else
//! changes.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeMap;

use antumbra_cull::{
    DeclareError, Stage, StageError, StageOptions, Verdict, Verdicts, ViewSpec, read_back,
};
use antumbra_draw::GpuScene;
use antumbra_graph::Mode;
use antumbra_scene::{Camera, Stereo};
use antumbra_strategies::registry;
use antumbra_testing::{balls, frame, look_at, perspective, vulkan};
use antumbra_verify::{EntitySet, Oracle};
use glam::DVec3;

const SIZE: [u32; 2] = [160, 128];
const LATENCIES: [&str; 3] = ["same-frame", "frame-late", "on-gpu"];

/// A cube of 343 spheres that hide each other.
fn block() -> GpuScene {
    GpuScene::new(vulkan(), &mut balls(7)).unwrap()
}

/// A camera that looks at the cube's centre from an angle, in degrees.
fn camera(angle: f64) -> Camera {
    let angle = angle.to_radians();
    let eye = DVec3::new(angle.sin(), 0.3, angle.cos()) * 34.0;
    look_at(eye, DVec3::ZERO, perspective(0.7, 0.1))
}

fn eyes(angle: f64, interocular: f64) -> [Camera; 2] {
    let stereo = Stereo::new(interocular, 34.0).unwrap();
    stereo.eyes(&camera(angle)).unwrap()
}

fn stage(scene: &GpuScene, text: &str, views: &[&str]) -> Stage {
    antumbra_testing::stage(scene, text, antumbra_testing::views(views, SIZE))
}

#[test]
fn the_second_eye_asks_less_than_it_would_alone() {
    let scene = block();
    for latency in ["same-frame", "frame-late"] {
        let settings = format!("latency={latency}:together=1");
        let mut twice = stage(&scene, &format!("coherent:{settings}"), &["left", "right"]);
        let mut once = stage(
            &scene,
            &format!("stereo-coherent:{settings}"),
            &["left", "right"],
        );
        for step in 0..6 {
            let cameras = eyes(f64::from(step), 0.4);
            let alone = frame(&mut twice, &scene, &cameras);
            let reused = frame(&mut once, &scene, &cameras);
            if step < 2 {
                continue;
            }
            assert_eq!(
                alone[0].tested(),
                reused[0].tested(),
                "{latency}: the first eye is the same"
            );
            let seen = reused[0].drawn().count() as u32;
            assert!(
                reused[1].tested() + seen / 2 < alone[1].tested(),
                "{latency}, step {step}: {} of {}, {seen} visible",
                reused[1].tested(),
                alone[1].tested()
            );
        }
    }
}

#[test]
fn asking_together_asks_less() {
    let scene = block();
    let mut alone = stage(&scene, "coherent:latency=same-frame:together=1", &["main"]);
    let mut together = stage(&scene, "coherent:latency=same-frame:together=16", &["main"]);
    let mut asked = [0, 0];
    for step in 0..12 {
        // The camera moves, then stands still.
        let camera = camera(f64::from(step.min(6)) * 0.5);
        let one = &frame(&mut alone, &scene, &[camera])[0];
        let other = &frame(&mut together, &scene, &[camera])[0];
        if step >= 10 {
            let hidden = |verdicts: &Verdicts| verdicts.tested() - verdicts.drawn().count() as u32;
            asked[0] += hidden(one);
            asked[1] += hidden(other);
        }
    }
    assert!(asked[1] * 4 < asked[0], "{asked:?}");
}

#[test]
fn eyes_in_one_place_see_the_same() {
    let scene = block();
    for latency in LATENCIES {
        let text = format!("stereo-coherent:latency={latency}");
        let mut stage = stage(&scene, &text, &["left", "right"]);
        for step in 0..8 {
            let cameras = eyes(f64::from(step.min(3)) * 2.0, 0.0);
            assert_eq!(cameras[0], cameras[1]);
            frame(&mut stage, &scene, &cameras);
            // While the camera moves, a late answer may be missing in one view and not in the other.
            if latency == "frame-late" && step < 7 {
                continue;
            }
            let picture =
                |view| read_back::texture(scene.gpu(), stage.colour(view).unwrap()).unwrap();
            assert!(picture(0) == picture(1), "{latency}, step {step}");
        }
    }
}

#[test]
fn both_eyes_are_right_however_far_apart_they_are() {
    let scene = block();
    let mut oracle = Oracle::new(&scene, SIZE);
    for latency in ["same-frame", "on-gpu"] {
        let text = format!("stereo-coherent:latency={latency}");
        let mut stage = stage(&scene, &text, &["left", "right"]);
        assert!(stage.strategy().conservative());
        for (step, interocular) in [0.4, 0.4, 4.0, 40.0, 0.0].into_iter().enumerate() {
            let cameras = eyes(step as f64, interocular);
            let verdicts = frame(&mut stage, &scene, &cameras);
            for (camera, verdicts) in cameras.iter().zip(&verdicts) {
                let reference = oracle.render(&scene, camera, EntitySet::InFrustum).unwrap();
                for owner in reference.owners() {
                    assert!(verdicts.get(owner).draws(), "{latency}: slot {owner}");
                }
            }
        }
    }
}

#[test]
fn whoever_appears_is_drawn_within_the_frames_of_the_fraction() {
    let scene = block();
    let mut oracle = Oracle::new(&scene, SIZE);
    for latency in ["same-frame", "on-gpu"] {
        for (fraction, frames) in [(0.5, 2), (0.25, 4)] {
            let text = format!("coherent:latency={latency}:fraction={fraction}");
            let mut stage = stage(&scene, &text, &["main"]);
            assert!(!stage.strategy().conservative());
            for _ in 0..8 {
                frame(&mut stage, &scene, &[camera(0.0)]);
            }
            let moved = camera(9.0);
            let reference = oracle.render(&scene, &moved, EntitySet::InFrustum).unwrap();
            let mut late = Vec::new();
            for _ in 0..frames {
                let verdicts = &frame(&mut stage, &scene, &[moved])[0];
                let missing = |slot: &u32| !verdicts.get(*slot).draws();
                late.push(reference.owners().into_iter().filter(missing).count());
            }
            assert!(
                late[0] > 0,
                "{text}: nothing was late, and the test shows nothing"
            );
            assert_eq!(late.last(), Some(&0), "{text}: {late:?}");
        }
    }
}

#[test]
fn an_adaptive_fraction_asks_more_while_more_appears() {
    let scene = block();
    let text = "coherent:latency=same-frame:fraction=0.1:late=0.5:together=1";
    let mut stage = stage(&scene, text, &["main"]);
    let mut asked = |angle: f64| {
        let verdicts = frame(&mut stage, &scene, &[camera(angle)]).remove(0);
        let hidden = verdicts.tally()[Verdict::ALL
            .iter()
            .position(|v| *v == Verdict::Occluded)
            .unwrap()];
        f64::from(verdicts.tested() - verdicts.drawn().count() as u32) / f64::from(hidden)
    };
    let still = (0..30).map(|_| asked(0.0)).last().unwrap();
    let moving = (1..10)
        .map(|step| asked(f64::from(step) * 4.0))
        .last()
        .unwrap();
    assert!(still < 0.15, "{still}");
    assert!(moving > still * 2.0, "{still}, then {moving}");
}

#[test]
fn late_forms_record_into_somebody_elses_frame_and_waiting_ones_say_where_they_wait() {
    let scene = block();
    let options = StageOptions {
        mode: Mode::Embedded,
        ..StageOptions::default()
    };
    let waits = BTreeMap::from([
        ("coherent:latency=same-frame", 1),
        ("stereo-coherent:latency=same-frame", 3),
        ("coherent:latency=frame-late", 0),
        ("stereo-coherent:latency=frame-late", 0),
        ("stereo-coherent:latency=on-gpu", 0),
    ]);
    for (text, points) in waits {
        let two = text.starts_with("stereo");
        let views: &[&str] = if two { &["left", "right"] } else { &["main"] };
        let own = stage(&scene, text, views);
        assert_eq!(own.plan().sync_points(), points, "{text}");
        let specs = antumbra_testing::views(views, SIZE);
        let strategy = registry().parse(text).unwrap();
        let embedded = Stage::new(&scene, strategy, specs, options.clone());
        assert_eq!(embedded.is_ok(), points == 0, "{text}");
    }
}

#[test]
fn one_view_has_no_second_eye() {
    let scene = block();
    for latency in LATENCIES {
        let passes = |name: &str| -> Vec<String> {
            let stage = stage(&scene, &format!("{name}:latency={latency}"), &["main"]);
            let plan = stage.plan();
            plan.passes()
                .iter()
                .map(|pass| pass.name.to_owned())
                .collect()
        };
        assert_eq!(passes("coherent"), passes("stereo-coherent"), "{latency}");
    }
}

#[test]
fn bad_settings_are_refused_with_their_range() {
    for (setting, range) in [
        ("fraction=0", "above 0, at most 1"),
        ("fraction=-0.5", "above 0, at most 1"),
        ("fraction=1.01", "above 0, at most 1"),
        ("fraction=NaN", "above 0, at most 1"),
        ("late=-1", "from 0"),
        ("late=inf", "1000000"),
        ("together=0", "1 to 256"),
        ("resort=-0.1", "from 0"),
        ("latency=tomorrow", "frame-late"),
    ] {
        for name in ["coherent", "stereo-coherent"] {
            let error = registry()
                .parse(&format!("{name}:{setting}"))
                .err()
                .unwrap_or_else(|| panic!("{setting} was taken"));
            assert!(error.to_string().contains(range), "{error}");
        }
    }
    let strategy = registry().parse("coherent:latency=on-gpu:late=2").unwrap();
    let specs = vec![ViewSpec::main(32, 32)];
    let error = Stage::new(&block(), strategy, specs, StageOptions::default()).unwrap_err();
    assert!(
        matches!(&error, StageError::Declare(DeclareError::Settings { conflict, .. }) if conflict.contains("late")),
        "{error}"
    );
}
