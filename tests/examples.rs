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
#[path = "../examples/gpu_strategy.rs"]
#[allow(dead_code, reason = "its main is run by hand")]
mod gpu_strategy;
#[path = "../examples/judge/main.rs"]
#[allow(dead_code, reason = "its main is run by hand")]
mod judge;
#[path = "../examples/own_renderer.rs"]
#[allow(dead_code, reason = "its main is run by hand")]
mod own_renderer;

use antumbra::cull::MeshDetail;
use antumbra::cull::{FrustumOnly, Strategy};
use antumbra::glam::{DVec2, DVec3};
use antumbra::measure::compare::{CompareOptions, Contender, compare};
use antumbra::measure::path::CameraPath;
use antumbra::verify::kit::{self, Kit};
use antumbra_testing::{SceneBuilder, auto, balls, gl, over_pixels};
use custom_strategy::LargestOccluders;
use gpu_strategy::MipPyramid;

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
fn the_strategy_on_the_gpu_conforms() {
    let strategy = MipPyramid::new().unwrap();
    assert!(strategy.conservative());
    for gpu in [auto(), gl()] {
        let make = || Box::new(strategy.clone()) as Box<dyn Strategy>;
        let report = Kit::default().check_on(gpu, make);
        let report = report.unwrap_or_else(|failure| panic!("{failure}"));
        // Four samples a pixel too, except where shaders cannot read them.
        let left_out = report.left_out.iter().map(|left| left.setup.samples);
        let expected: &[u32] = if gpu.reads_drawn_samples() {
            &[]
        } else {
            &[4, 4]
        };
        assert_eq!(left_out.collect::<Vec<_>>(), expected, "{}", gpu.title());
    }
}

#[test]
fn the_strategy_on_the_gpu_culls_what_is_hidden() {
    let options = CompareOptions {
        // Both sides are odd, and so are those of most levels.
        size: [251, 175],
        least_seconds: 0.0,
        ..CompareOptions::default()
    };
    for gpu in [auto(), gl()] {
        let comparison = gpu_strategy::run(gpu, 8, 24, &options).unwrap();
        let strategies = comparison.report.strategies;
        let [frustum, ideal, ours] = strategies.as_slice() else {
            panic!("three contenders, three entries");
        };
        assert_eq!(ours.error.false_culls.entities, 0);
        let culls = |drawn: f64| frustum.drawn.entities - drawn;
        let share = culls(ours.drawn.entities) / culls(ideal.drawn.entities);
        assert!(share > 0.3, "{share} of what could be culled");
    }
}

/// Sides whose halves are odd, too. A texel of the pyramid that lost its last column or row would hide what shows there alone.
#[test]
fn the_strategy_on_the_gpu_sees_the_last_column_and_row() {
    let size = [251, 175];
    let corner = DVec2::new(125.5, -87.5);
    let mut built = SceneBuilder::new();
    // A box behind another, by two corners in pixels.
    let mut cube = |depth: f64, one: DVec2, other: DVec2| {
        let middle = (one + other) * 0.5;
        built.cube(middle.extend(-depth), (one - other).abs().extend(1.0));
    };
    cube(
        10.0,
        DVec2::new(-130.0, 90.0),
        corner + DVec2::new(-1.0, 1.0),
    );
    cube(20.0, DVec2::ZERO, DVec2::splat(5.0));
    let lengths = [0.8, 3.0, 7.0, 15.0, 40.0, 80.0, 160.0];
    for (length, place) in lengths.into_iter().zip(1u32..) {
        let place = f64::from(place) * 20.0;
        let across = DVec2::new(125.4, place - 80.0);
        cube(20.0, across, across - DVec2::new(length, 0.8));
        let upright = DVec2::new(place - 90.0, -87.4);
        cube(20.0, upright, upright + DVec2::new(0.8, length));
    }
    let mut scene = built.scene;
    scene.update();
    let kit = Kit {
        size,
        ..Kit::default()
    };
    let strategy = MipPyramid::new().unwrap();
    let frames = vec![vec![over_pixels(DVec3::ZERO, size)]; 4];
    for gpu in [auto(), gl()] {
        let make = || Box::new(strategy.clone()) as Box<dyn Strategy>;
        let verdicts = kit.check_scene(gpu, make, &scene, &frames).unwrap();
        // The wall and the bars, and not the box that nothing shows.
        let drawn = verdicts[3][0].drawn().count();
        assert_eq!(drawn, 1 + 2 * lengths.len(), "{}", gpu.title());
    }
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
