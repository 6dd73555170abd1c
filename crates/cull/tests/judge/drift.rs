//! What an eye that goes on as it was said to does not uncover.

use std::time::{Duration, Instant};

use antumbra_cull::judge::*;
use antumbra_testing::engine::Drawn;
use antumbra_testing::gpus;
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3, Mat4};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64Mcg;

use crate::late_lists::hidden;
use crate::play::{Play, hosts};

const SIZE: [u32; 2] = [200, 160];

/// A wall with windows, all in one plane, so that nothing opens between two of its pieces: z = -distance + slope * (x, y).
#[derive(Debug, Clone, Copy)]
struct Wall {
    distance: f64,
    slope: DVec2,
}

impl Wall {
    fn any(random: &mut Pcg64Mcg) -> Self {
        let mut slope = || random.random_range(-0.6..0.6);
        Self {
            distance: 10.0,
            slope: DVec2::new(slope(), slope()),
        }
    }

    /// How far ahead it is in a point of the image.
    fn ahead(&self, projection: &Mat4, at: DVec2) -> f64 {
        self.distance / (1.0 + self.slope.dot(at / scale(projection)))
    }

    /// A piece of it, one metre and a half wide and high.
    fn piece(&self, column: i32, row: i32) -> DAffine3 {
        let middle = DVec2::new(f64::from(column), f64::from(row)) * 1.5;
        let half = 0.76;
        let axes = DMat3::from_cols(
            DVec3::new(half, 0.0, half * self.slope.x),
            DVec3::new(0.0, half, half * self.slope.y),
            DVec3::ZERO,
        );
        let centre = middle.extend(self.slope.dot(middle) - self.distance);
        DAffine3::from_mat3_translation(axes, centre)
    }
}

/// By how much the image is wider than the view, along each of its axes.
fn scale(projection: &Mat4) -> DVec2 {
    DVec2::new(
        f64::from(projection.x_axis.x),
        f64::from(projection.y_axis.y),
    )
}

/// Points all over the image.
fn image() -> impl Iterator<Item = DVec2> {
    let side = |number: u32| f64::from(number) / 16.0 - 1.0;
    (0..33 * 33).map(move |number| DVec2::new(side(number % 33), side(number / 33)))
}

/// How far an eye may go until something that is far away moves by `pixels` relative to the wall, somewhere in the image.
fn length_of(projection: &Mat4, wall: Wall, way: DVec3, pixels: f64) -> f64 {
    let half = DVec2::new(f64::from(SIZE[0]), f64::from(SIZE[1])) * 0.5;
    let lengths = image().map(|at| {
        let ahead = wall.ahead(projection, at);
        // What it passes on its way stays before it.
        let most = if way.z < 0.0 {
            -0.7 * ahead / way.z
        } else {
            f64::INFINITY
        };
        let moves = (scale(projection) * way.truncate() + at * way.z) * half;
        most.min(pixels * ahead / moves.abs().max_element())
    });
    lengths.fold(f64::INFINITY, f64::min)
}

fn boxes_behind(random: &mut Pcg64Mcg, projection: &Mat4, wall: Wall) -> Vec<DAffine3> {
    let one = |_| {
        let mut within = |half: f64| random.random_range(-half..half);
        let at = DVec2::new(within(1.0), within(1.0));
        let axis = DVec3::new(within(1.0), within(1.0), within(1.0) + 2.0).normalize();
        let turned = DQuat::from_axis_angle(axis, within(3.0));
        let size = DVec3::new(within(1.0), within(1.0), within(1.0));
        let size = size.to_array().map(|side| 10f64.powf(side * 0.7 - 0.3));
        let ahead = wall.ahead(projection, at) * (3.5 + within(2.4));
        let place = (at / scale(projection)).extend(-1.0) * ahead;
        DAffine3::from_scale_rotation_translation(DVec3::from_array(size), turned, place)
    };
    (0..200).map(one).collect()
}

/// A part of a box of one, at one of its corners.
fn corner(random: &mut Pcg64Mcg) -> DAffine3 {
    let part = random.random_range(0.1..0.7);
    let side = [(); 3].map(|()| if random.random() { 1.0 } else { -1.0 });
    let at = DVec3::from_array(side) * (1.0 - part);
    DAffine3::from_scale_rotation_translation(DVec3::splat(part), DQuat::IDENTITY, at)
}

/// A box's colour in the engine's pictures.
fn colour(index: u32) -> [u8; 3] {
    let hash = (index + 1).wrapping_mul(2_654_435_769);
    [8, 16, 24].map(|bits| (hash >> bits) as u8)
}

/// Whether a box can be seen by more than lies between samples.
fn is_seen(pixels: &[u8], index: u32) -> bool {
    let [wide, high] = SIZE.map(|side| side as usize);
    let colour = colour(index);
    let is_its = |x: usize, y: usize| pixels[(y * wide + x) * 4..][..3] == colour;
    let is_block = |x: usize, y: usize| (0..9).all(|at| is_its(x + at % 3, y + at / 3));
    (0..high - 2).any(|y| (0..wide - 2).any(|x| is_block(x, y)))
}

/// What a judge finds hidden, with the pieces of the wall alone in the depth.
fn judge(play: &mut Play, projection: Mat4, drift: Drift, pieces: &[u32]) -> Vec<u32> {
    let eye = Eye {
        drift,
        ..Eye::new(projection, DVec3::ZERO)
    };
    let gpu = play.gpu.clone();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    play.judge
        .begin(&mut play.instances, &[eye], &mut encoder)
        .unwrap();
    play.culled.look(projection, DVec3::ZERO);
    play.culled.draw(&mut encoder, Drawn::List(pieces), true);
    let report = play
        .judge
        .test(&[play.culled.depth()], &mut encoder)
        .unwrap();
    gpu.queue.submit([encoder.finish()]);
    // Who waits on the same device in another test may be about to deliver the answers.
    let patience = Instant::now() + Duration::from_secs(60);
    while Instant::now() < patience {
        gpu.wait().unwrap();
        if let Some((frame, found)) = hidden(play)
            && frame == report.frame
        {
            return found;
        }
        std::thread::yield_now();
    }
    panic!("no answers about frame {}", report.frame);
}

/// The hidden boxes that an eye sees elsewhere.
fn seen_from(
    play: &mut Play,
    projection: Mat4,
    eye: DVec3,
    pieces: &[u32],
    found: &[u32],
) -> Vec<u32> {
    let all = [pieces, found].concat();
    let mut encoder = play.gpu.device.create_command_encoder(&Default::default());
    play.culled.look(projection, eye);
    play.culled.draw(&mut encoder, Drawn::List(&all), true);
    play.gpu.queue.submit([encoder.finish()]);
    let pixels = play.culled.pixels();
    let seen = found.iter().filter(|index| is_seen(&pixels, **index));
    seen.copied().collect()
}

/// More worlds with the variable `JUDGE_TRIALS`.
#[test]
fn what_is_hidden_with_a_drift_stays_hidden_on_the_way() {
    let trials = std::env::var("JUDGE_TRIALS").ok();
    let trials: u64 = trials.map_or(24, |number| number.parse().unwrap());
    let (depth, projection) = hosts()[0];
    let mut kept = 0;
    let mut uncovered_without = 0;
    for seed in 0..trials {
        let gpu = gpus()[(seed % 2) as usize];
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let wall = Wall::any(&mut random);
        let mut play = Play::new(gpu, SIZE, depth, Phases::Late, seed);
        for piece in 0..30 * 30 {
            if random.random_range(0..5) > 0 {
                play.add(wall.piece(piece % 30 - 15, piece / 30 - 15), Part::Exempt);
            }
        }
        let pieces: Vec<u32> = (0..play.places.len() as u32).collect();
        for at in boxes_behind(&mut random, &projection, wall) {
            play.add(at, Part::Occludee);
            play.add(at * corner(&mut random), Part::Occludee);
        }
        play.culled.place(&play.places);
        let aside = DVec2::new(
            random.random_range(-1.0..1.0),
            random.random_range(-1.0..1.0),
        );
        let way = match seed / 2 % 4 {
            0 => aside.extend(0.0),
            1 => (aside * 0.3).extend(1.0),
            _ => (aside * 0.3).extend(-1.0),
        };
        let pixels = random.random_range(4.0..24.0);
        let length = length_of(&projection, wall, way, pixels);
        let drift = Drift {
            way: way.as_vec3(),
            pixels: pixels as f32,
        };
        let found = judge(&mut play, projection, drift, &pieces);
        kept += found.len();
        for inner in (pieces.len() as u32 + 1..play.places.len() as u32).step_by(2) {
            // What is outside of the view is not hidden.
            let centre = play.places[inner as usize].unwrap().translation;
            let at = scale(&projection) * centre.truncate() / -centre.z;
            assert!(
                !found.contains(&(inner - 1))
                    || found.contains(&inner)
                    || at.abs().max_element() > 1.0,
                "seed {seed}, {drift:?}: {} is hidden, and {inner} within it is not",
                inner - 1
            );
        }
        for part in [0.4, 0.7, 0.98] {
            let eye = way * length * part;
            let seen = seen_from(&mut play, projection, eye, &pieces, &found);
            assert!(
                seen.is_empty(),
                "seed {seed}, {drift:?}, at {part}: {seen:?}"
            );
        }
        let found = judge(&mut play, projection, Drift::NONE, &pieces);
        let seen = seen_from(&mut play, projection, way * length, &pieces, &found);
        uncovered_without += seen.len();
    }
    assert!(
        uncovered_without > 20 && kept > 1000,
        "{uncovered_without} uncovered without a drift, {kept} hidden with one"
    );
}
