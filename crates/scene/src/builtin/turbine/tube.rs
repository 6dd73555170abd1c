//! Tubes: a circle swept along a way.

use super::solid::{Sheet, Solid};
use glam::DVec3;
use std::f64::consts::TAU;

impl Solid {
    /// Adds a tube along `way` (at least two places), closed at both ends. Its section is carried on without twist.
    pub fn tube(&mut self, way: &[DVec3], radius: f64, sides: usize) {
        let frames = frames(way);
        let on = |row: usize, side: usize| {
            let (middle, normal, beside) = frames[row];
            // Backwards around the way, so that the outside is in front.
            let (sin, cos) = (-TAU * side as f64 / sides as f64).sin_cos();
            middle + (normal * cos + beside * sin) * radius
        };
        self.sheet(Sheet::round(frames.len(), sides), on);
        let last = frames.len() - 1;
        let face: Vec<_> = (0..sides).map(|side| on(0, side)).collect();
        self.fan(&face);
        let face: Vec<_> = (0..sides).rev().map(|side| on(last, side)).collect();
        self.fan(&face);
    }
}

/// Along the way, the directions of its rear neighbour and its fore neighbour evened out.
pub(super) fn direction(way: &[DVec3], at: usize) -> DVec3 {
    let before = way[at.saturating_sub(1)];
    let after = way[(at + 1).min(way.len() - 1)];
    (after - before).normalize_or(DVec3::X)
}

/// Places with two directions across the way, which with the way are right-handed.
fn frames(way: &[DVec3]) -> Vec<(DVec3, DVec3, DVec3)> {
    let mut normal = direction(way, 0).any_orthonormal_vector();
    (0..way.len())
        .map(|at| {
            let along = direction(way, at);
            normal = normal.reject_from_normalized(along).normalize_or(normal);
            (way[at], normal, along.cross(normal))
        })
        .collect()
}

/// The way along straight runs between `corners`, its bends of at most `bend` metres, as `count` places at equal distances.
pub(super) fn rounded(corners: &[DVec3], bend: f64, count: usize) -> Vec<DVec3> {
    let mut fine = Vec::new();
    for (i, &corner) in corners.iter().enumerate() {
        if i == 0 || i + 1 == corners.len() {
            fine.push(corner);
            continue;
        }
        let [before, after] = [corners[i - 1], corners[i + 1]].map(|other| {
            let run = other - corner;
            corner + run.normalize_or_zero() * bend.min(run.length() * 0.5)
        });
        // A parabola that touches both runs.
        fine.extend((0..=8).map(|step| {
            let t = f64::from(step) / 8.0;
            before.lerp(corner, t).lerp(corner.lerp(after, t), t)
        }));
    }
    evenly(&fine, count)
}

/// `count` places at equal distances along a way.
fn evenly(way: &[DVec3], count: usize) -> Vec<DVec3> {
    let length: f64 = way.windows(2).map(|run| run[0].distance(run[1])).sum();
    let mut runs = way.windows(2).map(|run| (run[0], run[1]));
    let (mut run, mut behind) = (runs.next(), 0.0);
    (0..count)
        .filter_map(|i| {
            let along = length * i as f64 / (count - 1) as f64;
            loop {
                let (from, to) = run?;
                let here = from.distance(to);
                let part = (along - behind) / here.max(f64::MIN_POSITIVE);
                if part <= 1.0 {
                    return Some(from.lerp(to, part.max(0.0)));
                }
                match runs.next() {
                    Some(next) => (run, behind) = (Some(next), behind + here),
                    None => return Some(to),
                }
            }
        })
        .collect()
}
