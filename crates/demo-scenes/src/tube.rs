//! Tubes: a circle swept along a path.

use super::solid::{Sheet, Solid};
use glam::DVec3;
use std::f64::consts::TAU;

impl Solid {
    /// Adds a tube along `way` (at least two points), closed at both ends. Its section is transported without twist.
    pub fn tube(&mut self, way: &[DVec3], radius: f64, sides: usize) {
        let frames = frames(way);
        let on = |row: usize, side: usize| {
            let Frame {
                centre,
                normal,
                binormal,
            } = frames[row];
            // Clockwise around the path, so that the front faces outwards.
            let (sin, cos) = (-TAU * side as f64 / sides as f64).sin_cos();
            centre + (normal * cos + binormal * sin) * radius
        };
        self.sheet(Sheet::round(frames.len(), sides), on);
        let last = frames.len() - 1;
        let face: Vec<_> = (0..sides).map(|side| on(0, side)).collect();
        self.fan(&face);
        let face: Vec<_> = (0..sides).rev().map(|side| on(last, side)).collect();
        self.fan(&face);
    }
}

/// Direction of the path at a point: from its predecessor to its successor.
pub(super) fn direction(way: &[DVec3], at: usize) -> DVec3 {
    let before = way[at.saturating_sub(1)];
    let after = way[(at + 1).min(way.len() - 1)];
    (after - before).normalize_or(DVec3::X)
}

/// A point of a path with two directions across it.
struct Frame {
    centre: DVec3,
    normal: DVec3,
    binormal: DVec3,
}

/// The frames of a path. Path direction, normal and binormal are right-handed.
fn frames(way: &[DVec3]) -> Vec<Frame> {
    let mut normal = direction(way, 0).any_orthonormal_vector();
    (0..way.len())
        .map(|at| {
            let along = direction(way, at);
            normal = normal.reject_from_normalized(along).normalize_or(normal);
            Frame {
                centre: way[at],
                normal,
                binormal: along.cross(normal),
            }
        })
        .collect()
}

/// Points of a bend.
const BEND_PLACES: usize = 7;

/// A path of `count` points with straight runs between `corners`. Each corner is replaced by a bend that starts at
/// most `bend` metres before it. All bends have the same number of points; the rest is distributed over the runs by
/// length.
pub(super) fn rounded_path(corners: &[DVec3], bend: f64, count: usize) -> Vec<DVec3> {
    let bends: Vec<[DVec3; 3]> = corners
        .windows(3)
        .map(|three| {
            // A part of each run stays straight, so that bends do not touch.
            let towards = |other: DVec3| {
                let run = other - three[1];
                three[1] + run.normalize_or_zero() * bend.min(run.length() * 0.45)
            };
            [towards(three[0]), three[1], towards(three[2])]
        })
        .collect();
    let starts = corners
        .iter()
        .take(1)
        .chain(bends.iter().map(|bend| &bend[2]));
    let ends = bends.iter().map(|bend| &bend[0]).chain(corners.last());
    let runs: Vec<(DVec3, DVec3)> = starts.copied().zip(ends.copied()).collect();
    let length: f64 = runs.iter().map(|(from, to)| from.distance(*to)).sum();
    let spread = count.saturating_sub(2 + bends.len() * BEND_PLACES);
    let mut way: Vec<DVec3> = corners.iter().take(1).copied().collect();
    let (mut along, mut given) = (0.0, 0);
    for (i, (from, to)) in runs.iter().enumerate() {
        along += from.distance(*to);
        let last = i + 1 == runs.len();
        let until = if last {
            spread
        } else {
            (along / length * spread as f64) as usize
        };
        let inner = until - given;
        way.extend((1..=inner).map(|k| from.lerp(*to, k as f64 / (inner + 1) as f64)));
        given = until;
        match bends.get(i) {
            // A parabola tangential to both runs.
            Some([before, corner, after]) => way.extend((0..BEND_PLACES).map(|k| {
                let t = k as f64 / (BEND_PLACES - 1) as f64;
                before.lerp(*corner, t).lerp(corner.lerp(*after, t), t)
            })),
            None => way.push(*to),
        }
    }
    way
}
