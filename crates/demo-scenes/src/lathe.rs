//! Solids of revolution around the axis X, and prisms along it.
//!
//! Profiles are [x, radius] in metres, counter-clockwise with x to the right and the radius upwards.

use super::solid::{Sheet, Solid, polar};
use glam::DVec2;
use std::f64::consts::TAU;

/// Cosine of the angle from which an edge of a profile is sharp: 35 degrees.
const CREASE: f64 = 0.819;

impl Solid {
    /// Adds the ring that a closed profile sweeps.
    pub fn revolve_closed(&mut self, profile: &[[f64; 2]], sides: usize) {
        let count = profile.len();
        let edges: Vec<usize> = (0..count)
            .filter(|&i| {
                let [before, after] = [(i + count - 1) % count, (i + 1) % count];
                sharp([profile[before], profile[i], profile[after]])
            })
            .collect();
        if edges.is_empty() {
            let sheet = Sheet {
                rows_wrap: true,
                ..Sheet::round(count, sides)
            };
            self.sheet(sheet, |row, side| on_circle(profile[row], side, sides));
        }
        for (i, &from) in edges.iter().enumerate() {
            let to = edges[(i + 1) % edges.len()];
            let length = (to + count - from - 1) % count + 1;
            self.sheet(Sheet::round(length + 1, sides), |row, side| {
                on_circle(profile[(from + row) % count], side, sides)
            });
        }
    }

    /// Adds the solid that an open profile sweeps. The profile begins and ends on the axis, its rear end first.
    pub fn revolve(&mut self, profile: &[[f64; 2]], sides: usize) {
        let mut from = 0;
        for to in 1..profile.len() {
            let last = to + 1 == profile.len();
            if last || sharp([profile[to - 1], profile[to], profile[to + 1]]) {
                let run = &profile[from..=to];
                self.sheet(Sheet::round(run.len(), sides), |row, side| {
                    on_circle(run[row], side, sides)
                });
                from = to;
            }
        }
    }

    /// Adds a cylinder between two positions on the axis.
    pub fn cylinder(&mut self, radius: f64, x: [f64; 2], sides: usize) {
        let [front, rear] = x;
        let profile = [[rear, 0.0], [rear, radius], [front, radius], [front, 0.0]];
        self.revolve(&profile, sides);
    }

    /// Adds a ring of rectangular section.
    pub fn band(&mut self, x: [f64; 2], radius: [f64; 2], sides: usize) {
        let ([front, rear], [inner, outer]) = (x, radius);
        let profile = [[front, inner], [rear, inner], [rear, outer], [front, outer]];
        self.revolve_closed(&profile, sides);
    }

    /// Adds a torus.
    pub fn torus(&mut self, x: f64, radius: f64, thick: f64, steps: [usize; 2]) {
        let [section, sides] = steps;
        let profile: Vec<[f64; 2]> = (0..section)
            .map(|i| {
                let (sin, cos) = (TAU * i as f64 / section as f64).sin_cos();
                [x + thick * cos, radius + thick * sin]
            })
            .collect();
        self.revolve_closed(&profile, sides);
    }

    /// Adds a prism with flat sides between two positions on the axis.
    pub fn prism(&mut self, radius: f64, x: [f64; 2], sides: usize) {
        let [front, rear] = x;
        let corner = |x: f64, side: usize| on_circle([x, radius], side % sides, sides);
        for side in 0..sides {
            self.sheet(Sheet::open(2, 2), |row, column| {
                corner(if row == 0 { rear } else { front }, side + column)
            });
        }
        let face: Vec<_> = (0..sides).map(|side| corner(rear, side)).collect();
        self.fan(&face);
        let face: Vec<_> = (0..sides).rev().map(|side| corner(front, side)).collect();
        self.fan(&face);
    }
}

fn on_circle(point: [f64; 2], side: usize, sides: usize) -> glam::DVec3 {
    let [x, radius] = point;
    polar(x, radius, TAU * side as f64 / sides as f64)
}

/// Whether the angle of a profile at the second of three points makes a sharp edge.
fn sharp(points: [[f64; 2]; 3]) -> bool {
    let [before, here, after] = points.map(DVec2::from);
    let [into, out] = [here - before, after - here].map(DVec2::normalize_or_zero);
    into.dot(out) < CREASE
}
