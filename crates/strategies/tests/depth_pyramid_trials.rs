//! Trials of `depth-pyramid` with two phases: an entity of any size and turn, under a camera of any projection, in an image of any size with any number of samples a
//! pixel. None that owns a pixel may be culled. TRIALS=1000000 in the environment plays so many on each driver.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Gpu, StageOptions, Verdict};
use antumbra_draw::GpuScene;
use antumbra_scene::{Aabb, Camera, ClipMatrix, Geometry, Mesh, Projection, Scene};
use antumbra_strategies::DepthPyramid;
use antumbra_testing::{SceneBuilder, frame, gl, stage_with, views, vulkan};
use antumbra_verify::{EntitySet, Oracle};
use glam::{DAffine3, DMat4, DQuat, DVec2, DVec3, DVec4};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

/// Entities of a world.
const ENTITIES: u32 = 1500;
/// Frames that a world is looked at, each from another place.
const FRAMES: u32 = 4;

fn trials() -> u64 {
    std::env::var("TRIALS").map_or(20_000, |text| text.parse().unwrap())
}

fn turn(random: &mut Pcg32) -> DQuat {
    let mut number = || random.random_range(-1.0..1.0);
    let axis = DVec3::new(number(), number(), number() + 1.5).normalize();
    DQuat::from_axis_angle(axis, number() * 3.1)
}

/// Thin beams along all axes: a mesh whose box is mostly empty, so that the boxes of its parts are tested too.
fn beams(random: &mut Pcg32) -> Mesh {
    let mut made = Geometry::default();
    for number in 0..7 {
        let mut between = |low: f64, high: f64| random.random_range(low..high);
        let middle = DVec3::from_array([(); 3].map(|()| between(-0.8, 0.8)));
        let mut half = DVec3::from_array([(); 3].map(|()| 10f64.powf(between(-2.0, -1.0))));
        half[number % 3] = between(0.1, 0.6);
        let beam = Geometry::from_box(&Aabb::from_centre(middle, half));
        let first = made.positions.len() as u32;
        made.positions.extend(&beam.positions);
        let indices = beam.indices.iter();
        made.indices.extend(indices.map(|index| first + index));
    }
    Mesh::new("beams", made)
}

/// Boxes, balls, squares and beams from a speck to a wall, some flat or long, in a cube of 20 m around a place that may be far from the origin.
fn world(random: &mut Pcg32, origin: DVec3) -> Scene {
    let mut builder = SceneBuilder::new();
    let beams = [(); 4].map(|()| builder.scene.add_mesh(beams(random)).unwrap());
    let spread = random.random_range(2.0..10.0);
    for _ in 0..ENTITIES {
        let place = DVec3::from_array([(); 3].map(|()| random.random_range(-spread..spread)));
        let metres = 10f64.powf(random.random_range(-2.0..0.5));
        let sides = match random.random_range(0..3) {
            0 => DVec3::from_array([(); 3].map(|()| 10f64.powf(random.random_range(-1.5..0.3)))),
            _ => DVec3::ONE,
        };
        let mesh = match random.random_range(0..4) {
            0 => beams[random.random_range(0..4)],
            other => [builder.cube, builder.ball, builder.square][other - 1],
        };
        let at =
            DAffine3::from_scale_rotation_translation(sides * metres, turn(random), origin + place);
        builder.put(mesh, at);
    }
    builder.scene
}

/// A near plane that is not at right angles to the view, with forward or reversed depth.
fn oblique(random: &mut Pcg32) -> ClipMatrix {
    let mut around = |middle: f64, reach: f64| middle + random.random_range(-reach..reach);
    let w = match around(0.0, 1.0) > 0.0 {
        true => DVec4::W * 8.0,
        false => DVec4::new(0.0, 0.0, -1.0, 0.0),
    };
    let scale = around(1.0, 0.6);
    let x = DVec4::new(scale, 0.0, around(0.0, 0.3), 0.0);
    let y = DVec4::new(0.0, scale, around(0.0, 0.3), 0.0);
    let plane = DVec4::new(around(0.0, 0.3), around(0.0, 0.3), -1.0, around(-1.0, 0.5));
    let near = plane * if w.w > 0.0 { 0.05 } else { 0.5 };
    let rows = |rows: [DVec4; 4]| DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose();
    match around(0.0, 1.0) > 0.0 {
        true => ClipMatrix::reversed(rows([x, y, w - near, w])).unwrap(),
        false => ClipMatrix::forward(rows([x, y, near, w])).unwrap(),
    }
}

fn projection(random: &mut Pcg32) -> Projection {
    let fov_y = random.random_range(0.2..2.4);
    let near = 10f64.powf(random.random_range(-3.0..0.5));
    match random.random_range(0..4) {
        0 => Projection::Perspective { fov_y, near },
        1 => Projection::OffAxis {
            fov_y,
            near,
            shift: DVec2::new(
                random.random_range(-0.8..0.8),
                random.random_range(-0.8..0.8),
            ),
        },
        2 => Projection::Orthographic {
            height: random.random_range(1.0..30.0),
            near: random.random_range(-20.0..1.0),
            far: random.random_range(10.0..60.0),
        },
        _ => Projection::Matrix(oblique(random)),
    }
}

/// Entities in the frustum, in all frames.
#[derive(Default)]
struct Played {
    trials: u64,
    /// Those of them that were culled.
    culled: u64,
    /// Boxes of parts of meshes.
    parts: usize,
}

/// Plays a world of this seed.
fn play(gpu: &Gpu, seed: u64, played: &mut Played) {
    let mut random = Pcg32::seed_from_u64(seed);
    let size = [random.random_range(1..200), random.random_range(1..160)];
    let samples = match gpu.reads_drawn_samples() && seed % 3 == 1 {
        true => 4,
        false => 1,
    };
    let origin = DVec3::X * [0.0, 0.0, 3e5][(seed % 3) as usize];
    let scene = GpuScene::new(gpu, &mut world(&mut random, origin)).unwrap();
    played.parts += scene.table().part_boxes().len();
    let options = StageOptions {
        samples,
        ..StageOptions::default()
    };
    let strategy = Box::new(DepthPyramid::default());
    let mut stage = stage_with(&scene, strategy, views(&["main"], size), options);
    let mut oracle = Oracle::new(&scene, size).with_samples(samples);
    let projection = projection(&mut random);
    let mut eye = origin + turn(&mut random) * DVec3::Z * random.random_range(0.0..15.0);
    let mut rotation = turn(&mut random);
    // From far away all of it is in view, as a rule.
    if random.random_range(0..3) > 0 {
        let towards = (origin - eye).try_normalize().unwrap_or(DVec3::NEG_Z);
        rotation = DQuat::from_rotation_arc(DVec3::NEG_Z, towards);
    }
    for number in 0..FRAMES {
        let camera = Camera::new(projection, eye, rotation).unwrap();
        let verdicts = frame(&mut stage, &scene, &[camera]).remove(0);
        let reference = oracle
            .render(&scene, &camera, EntitySet::InFrustum)
            .unwrap();
        for slot in reference.owners() {
            let verdict = verdicts.get(slot);
            assert!(
                verdict.draws(),
                "seed {seed}, frame {number}, {size:?}, {samples} samples on {}: slot {slot} owns a pixel and is {verdict:?}; {camera:?}",
                gpu.title()
            );
        }
        played.culled += verdicts.of_kind(Verdict::Occluded).count() as u64;
        played.trials += Verdict::ALL
            .into_iter()
            .filter(|kind| *kind != Verdict::OutsideFrustum)
            .map(|kind| verdicts.of_kind(kind).count() as u64)
            .sum::<u64>();
        eye += DVec3::from_array([(); 3].map(|()| random.random_range(-0.4..0.4)));
        rotation *= DQuat::from_rotation_y(random.random_range(-0.1..0.1));
    }
}

fn play_all(gpu: &Gpu) {
    let mut played = Played::default();
    let mut seed = 0;
    while played.trials < trials() {
        play(gpu, seed, &mut played);
        seed += 1;
    }
    let Played {
        trials,
        culled,
        parts,
    } = played;
    assert!(
        parts as u64 > seed * 10,
        "only {parts} boxes of parts in {seed} worlds"
    );
    println!(
        "{trials} trials of the seeds 0 to {} on {}: {culled} culled, none of them falsely",
        seed - 1,
        gpu.title()
    );
    assert!(culled > trials / 10, "only {culled} of {trials} are culled");
}

#[test]
fn no_trial_culls_what_owns_a_pixel_on_vulkan() {
    play_all(vulkan());
}

#[test]
fn no_trial_culls_what_owns_a_pixel_on_gl() {
    play_all(gl());
}
