//! Guarded late answers cull nothing that is visible while the eye goes no farther than the guard allows, with any number of frames in flight; unguarded ones do, on the same walks.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Gpu, Stage, StageOptions, Verdict, ViewInput};
use antumbra_draw::GpuScene;
use antumbra_graph::LateResults;
use antumbra_scene::{Camera, EntityKey, Material, Scene, icosphere};
use antumbra_strategies::registry;
use antumbra_testing::{
    add, balls, cuboid, drawable, glass, gpus, look_at, perspective, stage_with, views, vulkan,
};
use antumbra_verify::{EntitySet, Oracle};
use glam::{DAffine3, DVec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

const SIZE: [u32; 2] = [240, 180];
const FRAMES: usize = 14;
/// Metres that the eye goes a frame.
const STEP: f64 = 0.15;

/// All strategies with late answers. `three-pass` tests full meshes against proxies of a quarter of the image: what it believes is wrong often, and what is confirmed is not.
const LATE: [&str; 4] = [
    "coherent:",
    "occupancy-map:",
    "chc-plus-plus:",
    "three-pass:threshold=0:scale=0.25:",
];
const GUARD: &str = "guard=0.16:guard-turn=2";

/// Houses of a town and what lies about between them: balls, some of glass.
struct Town {
    scene: Scene,
    houses: Vec<EntityKey>,
    balls: Vec<(EntityKey, DVec3)>,
}

fn town(seed: u64) -> Town {
    let mut random = Pcg32::seed_from_u64(seed);
    let mut scene = Scene::new();
    let house = cuboid(DVec3::ONE);
    let house = drawable(&mut scene, "house", house, Material::default());
    let ball = icosphere(1, 0.15);
    let solid = drawable(&mut scene, "ball", ball.clone(), Material::default());
    let clear = drawable(&mut scene, "bubble", ball, glass([0.5, 0.7, 0.9, 0.4]));
    let mut houses = Vec::new();
    let mut balls = Vec::new();
    for at in 0..49 {
        let (column, row) = (f64::from(at % 7) - 3.0, f64::from(at / 7) - 3.0);
        let middle = DVec3::new(column, 0.0, row) * 9.0;
        let size = DVec3::new(
            random.random_range(4.0..6.5),
            random.random_range(4.0..9.0),
            random.random_range(4.0..6.5),
        );
        let turned = DAffine3::from_rotation_y(random.random_range(-0.3..0.3));
        let place = DAffine3::from_translation(middle + DVec3::Y * size.y / 2.0);
        let place = place * turned * DAffine3::from_scale(size);
        houses.push(add(&mut scene, place, house));
        for _ in 0..16 {
            let off = DVec3::new(
                random.random_range(-4.5..4.5),
                random.random_range(0.3..3.0),
                random.random_range(-4.5..4.5),
            );
            let shape = match random.random_range(0..5) {
                0 => clear,
                _ => solid,
            };
            let place = middle + off;
            balls.push((
                add(&mut scene, DAffine3::from_translation(place), shape),
                place,
            ));
        }
    }
    scene.update();
    Town {
        scene,
        houses,
        balls,
    }
}

/// A walk across a street, past the corners of houses, that looks about.
fn walk(frame: usize) -> Camera {
    let at = frame as f64;
    let eye = DVec3::new(5.2 - 0.11 * at, 1.7, 20.0 - 0.09 * at);
    let angle = (at * 0.7).sin() * 2f64.to_radians();
    let target = eye + DVec3::new(angle.sin(), -0.02, -angle.cos());
    look_at(eye, target, perspective(1.0, 0.1))
}

/// What a walk with one setting has come to.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
struct Tally {
    false_culls: usize,
    occluded: u32,
}

/// A stage with its setting and what it has come to.
struct Walker {
    what: String,
    stage: Stage,
    tally: Tally,
}

impl Walker {
    fn new(scene: &GpuScene, text: &str, frames_in_flight: u32) -> Self {
        let strategy = registry().parse(text).unwrap();
        let options = StageOptions {
            frames_in_flight,
            late_results: LateResults::OfFramesInFlight,
            ..StageOptions::default()
        };
        Self {
            what: format!("{text} with {frames_in_flight} in flight"),
            stage: stage_with(scene, strategy, views(&["main"], SIZE), options),
            tally: Tally::default(),
        }
    }
}

/// Plays a walk for all of these at once.
fn play(
    gpu: &Gpu,
    scene: &mut Scene,
    settings: &[(String, u32)],
    camera: impl Fn(usize) -> Camera,
    mut change: impl FnMut(&mut Scene, usize),
) -> Vec<Walker> {
    let mut on_gpu = GpuScene::new(gpu, scene).unwrap();
    let mut walkers: Vec<Walker> = settings
        .iter()
        .map(|(text, in_flight)| Walker::new(&on_gpu, text, *in_flight))
        .collect();
    let mut oracle = Oracle::new(&on_gpu, SIZE);
    for frame in 0..FRAMES {
        change(scene, frame);
        on_gpu.sync(scene).unwrap();
        let camera = camera(frame);
        let ids = oracle
            .render(&on_gpu, &camera, EntitySet::InFrustum)
            .unwrap();
        for walker in &mut walkers {
            walker
                .stage
                .frame(&on_gpu, &[ViewInput::new(camera)])
                .unwrap();
            on_gpu.gpu().wait().unwrap();
            let verdicts = walker.stage.verdicts(0, &on_gpu).unwrap();
            let found = oracle
                .differences(&on_gpu, &camera, &ids, &verdicts)
                .unwrap();
            walker.tally.false_culls += found.false_culls() + found.tied.len();
            let occluded = |slot: &u32| verdicts.get(*slot) == Verdict::Occluded;
            walker.tally.occluded += on_gpu.table().live_slots().filter(occluded).count() as u32;
        }
    }
    walkers
}

/// Every late strategy with one, two and three frames in flight.
fn all(suffix: &str) -> Vec<(String, u32)> {
    let each = |late: &str| {
        let text = format!("{late}{suffix}");
        (1..=3).map(move |in_flight| (text.trim_end_matches(':').to_owned(), in_flight))
    };
    LATE.into_iter().flat_map(each).collect()
}

#[test]
fn nothing_visible_is_culled_within_the_guard_and_without_it_something_is() {
    for gpu in gpus() {
        let mut without = Vec::new();
        for seed in [1, 2] {
            for walker in play(gpu, &mut town(seed).scene, &all(GUARD), walk, |_, _| ()) {
                let Tally {
                    false_culls,
                    occluded,
                } = walker.tally;
                assert_eq!(false_culls, 0, "town {seed}, {}", walker.what);
                assert!(occluded > 60, "town {seed}, {}: {occluded}", walker.what);
            }
            let plain = play(gpu, &mut town(seed).scene, &all(""), walk, |_, _| ());
            without.resize(plain.len(), 0);
            for (sum, walker) in without.iter_mut().zip(plain) {
                *sum += walker.tally.false_culls;
            }
        }
        assert!(without.iter().all(|culled| *culled > 0), "{without:?}");
    }
}

#[test]
fn what_moves_is_neither_hidden_nor_hides_by_where_it_was() {
    for seed in [3, 4] {
        let Town {
            mut scene,
            houses,
            balls,
        } = town(seed);
        let places: Vec<DAffine3> = houses
            .iter()
            .map(|house| scene.world(*house).unwrap())
            .collect();
        let change = |scene: &mut Scene, frame: usize| {
            let at = frame as f64;
            for (ball, place) in balls.iter().step_by(3) {
                let off = DVec3::new((at * 0.8).sin() * 6.0, 0.0, (at * 0.4).cos());
                scene
                    .set_local(*ball, DAffine3::from_translation(*place + off))
                    .unwrap();
            }
            // Most houses stand. One slides all the time, and another is lifted away after it has hidden things.
            let slid = DVec3::X * 1.5 * at;
            let lifted = DVec3::Y * if frame < 9 { 0.0 } else { 20.0 };
            for (number, off) in [(17, slid), (31, lifted)] {
                if off != DVec3::ZERO {
                    let place = DAffine3::from_translation(off) * places[number];
                    scene.set_local(houses[number], place).unwrap();
                }
            }
        };
        for walker in play(vulkan(), &mut scene, &all(GUARD), walk, change) {
            let Tally {
                false_culls,
                occluded,
            } = walker.tally;
            assert_eq!(false_culls, 0, "town {seed}, {}", walker.what);
            assert!(occluded > 20, "town {seed}, {}: {occluded}", walker.what);
        }
    }
}

/// How far the eye has come is checked, not believed.
#[test]
fn an_eye_faster_than_the_guard_finds_nothing_hidden() {
    let settings = all("guard=0.02");
    for walker in play(vulkan(), &mut town(1).scene, &settings, walk, |_, _| ()) {
        let Tally {
            false_culls,
            occluded,
        } = walker.tally;
        assert_eq!((false_culls, occluded), (0, 0), "{}", walker.what);
    }
    assert!(walk(0).position.distance(walk(1).position) < STEP);
}

/// Balls hide little of each other for certain, and nothing wrongly.
#[test]
fn a_block_of_balls_is_right() {
    let around = |frame: usize| {
        let angle = frame as f64 * 0.004;
        let eye = DVec3::new(angle.sin(), 0.3, angle.cos()) * 34.0;
        look_at(eye, DVec3::ZERO, perspective(0.5, 0.1))
    };
    for walker in play(vulkan(), &mut balls(6), &all(GUARD), around, |_, _| ()) {
        assert_eq!(walker.tally.false_culls, 0, "{}", walker.what);
    }
}

#[test]
fn with_a_guard_late_answers_are_promised_to_be_conservative() {
    let registry = registry();
    let promises = |text: &str| registry.parse(text).unwrap().conservative();
    for (text, _) in all(GUARD) {
        assert!(promises(&text), "{text}");
    }
    for text in [
        "coherent:guard=0",
        "coherent:latency=same-frame:guard=1:fraction=0.5",
        "three-pass:guard=1",
        "three-pass:threshold=0:coarser=10:guard=1",
        "occupancy-map:small=2:guard=1",
        "occupancy-map:latency=same-frame:occluded-for=2:guard=1",
    ] {
        assert!(!promises(text), "{text}");
    }
}
