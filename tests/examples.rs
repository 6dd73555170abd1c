//! The examples work: the custom strategy conforms and culls nothing visible, the embedded stage keeps the results of the host's passes, and
//! the flight through the sub-surface model reads only what is visible.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../examples/custom_strategy.rs"]
#[allow(dead_code, reason = "its main is run by hand")]
mod custom_strategy;
#[path = "../examples/embed.rs"]
#[allow(dead_code, reason = "its main is run by hand")]
mod embed;
#[path = "../examples/explore_subsurface.rs"]
#[allow(dead_code, reason = "its main is run by hand")]
mod explore_subsurface;

#[path = "../examples/judge/main.rs"]
#[allow(dead_code, reason = "its main is run by hand")]
mod judge;
#[path = "../examples/own_renderer.rs"]
#[allow(dead_code, reason = "its main is run by hand")]
mod own_renderer;

use antumbra::cull::MeshDetail;
use antumbra::cull::{FrustumOnly, Strategy};
use antumbra::measure::compare::{CompareOptions, Contender, compare};
use antumbra::measure::path::CameraPath;
use antumbra::verify::kit::{self, Kit};
use antumbra_testing::{auto, balls, gl};
use custom_strategy::LargestOccluders;

#[test]
fn the_strategy_from_outside_conforms() {
    let ours = |occludee| move || Box::new(LargestOccluders(20, occludee)) as Box<dyn Strategy>;
    assert!(ours(MeshDetail::Level(0))().conservative());
    kit::assert_conforms(ours(MeshDetail::Level(0)));
    kit::assert_conforms(ours(MeshDetail::Box));
    // On OpenGL, queries answer 0 or 1.
    let kit = Kit::default();
    kit.check_on(gl(), ours(MeshDetail::Level(0))).unwrap();
}

#[test]
fn the_strategy_from_outside_is_compared() {
    let mut scene = balls(8);
    scene.update();
    let path = CameraPath::orbit_around(&scene.bounds().unwrap(), 4.0 / 3.0, 6).unwrap();
    let contenders = [
        Contender::new("", || Box::new(FrustumOnly)),
        Contender::new("", || Box::new(LargestOccluders(250, MeshDetail::Box))),
    ];
    let options = CompareOptions {
        size: [160, 120],
        least_seconds: 0.0,
        ..CompareOptions::default()
    };
    let comparison = compare(
        auto(),
        &mut scene,
        &path,
        &contenders,
        &options,
        &mut |_| (),
    );
    let strategies = comparison.unwrap().report.strategies;
    let [frustum, ours] = strategies.as_slice() else {
        panic!("two contenders, two entries");
    };
    assert_eq!(ours.name, "largest-occluders");
    assert_eq!(ours.error.false_culls.entities, 0);
    assert!(ours.drawn.entities < 0.9 * frustum.drawn.entities);
}

#[test]
fn the_embedded_stage_keeps_our_passes() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("embed.png");
    let refusal = embed::run([160, 120], 4, &output).unwrap();
    assert!(refusal.contains("three-pass") && refusal.contains("sync point"));

    let image = image::open(&output).unwrap().to_rgba8();
    let count = |what: fn([u8; 4]) -> bool| image.pixels().filter(|pixel| what(pixel.0)).count();
    let board = |[r, _, b, _]: [u8; 4]| r == 255 && b == 0;
    let sky = |[r, _, b, _]: [u8; 4]| r == 0 && b > 100;
    let scene = |[r, _, b, _]: [u8; 4]| r > 0 && r.abs_diff(b) < 16;
    assert!(count(board) > 100, "the board was not drawn");
    assert!(count(sky) > 1_000, "the sky was not drawn, or not kept");
    assert!(count(scene) > 1_000, "the scene was not drawn");
    // The board covers most of the middle row, except where the scene is in front of it.
    let hidden = (16..144)
        .filter(|x| scene(image.get_pixel(*x, 60).0))
        .count();
    assert!(
        hidden > 10,
        "the board was not tested against the scene's depth"
    );
}

/// As the page on engines promises.
#[test]
fn a_stage_may_live_on_another_thread() {
    fn moves<T: Send>() {}
    moves::<antumbra::cull::Stage>();
    moves::<antumbra::draw::GpuScene>();
    moves::<antumbra::scene::Scene>();
}

#[test]
fn a_flight_reads_only_what_is_seen_and_goes_on_while_surfaces_come_and_go() {
    let dir = tempfile::tempdir().unwrap();
    let image = dir.path().join("subsurface.png");
    let mut options = antumbra::demo_scenes::subsurface::SubsurfaceSceneOptions::default();
    options.model.nodes_per_side = 64;
    options.prepare.tiles = 5;
    let explored = || explore_subsurface::run(options, [320, 256], 16, &image).unwrap();
    let first = explored();
    assert!(0 < first.bricks_read && first.bricks_read < first.bricks_crossed);
    assert!(first.drawn < first.entities * 2 / 3, "{first:?}");
    assert!(image.is_file());
    assert_eq!(first, explored(), "the same flight gave another result");
}

#[test]
fn a_renderer_of_ones_own_draws_what_strategies_choose() {
    let exact = "three-pass:latency=on-gpu:threshold=0:occluders=full:occludees=full:scale=1";
    for gpu in [auto(), gl()] {
        for strategy in [
            "frustum",
            exact,
            "coherent:latency=same-frame",
            "coherent:latency=on-gpu",
            "occupancy-map:latency=same-frame",
            "stop-and-wait:batch=64",
        ] {
            let outcome = own_renderer::run(gpu, strategy, 6).unwrap();
            assert_eq!(outcome.different_pixels, 0, "{strategy}: {outcome:?}");
            let culls = outcome.drawn * 4 < outcome.entities * 3;
            assert_eq!(culls, strategy != "frustum", "{strategy}: {outcome:?}");
        }
    }
}

#[test]
fn an_engine_that_asks_for_answers_draws_no_pixel_wrong() {
    for (gpu, samples) in [(auto(), 4), (gl(), 1)] {
        let play = judge::Play {
            samples,
            objects: 600,
            frames: 9,
            ..judge::Play::default()
        };
        let two = judge::run(gpu, play, None).unwrap();
        assert_eq!(two.wrong_pixels, 0);
        let [drawn, of] = two.drawn;
        assert!(drawn < of, "{drawn} of {of} drawn");
        let phases = antumbra::cull::judge::Phases::Late;
        let late = judge::run(gpu, judge::Play { phases, ..play }, None).unwrap();
        assert_eq!(late.wrong_at_rest, 0);
    }
}
