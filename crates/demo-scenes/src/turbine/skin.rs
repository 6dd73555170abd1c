//! The outside of the casings: where things stand on it, and where there is no opening in the way.

use super::assembly::shifted;
use super::plan::{CORE_CASE, CORE_FLANGES, FAN_CASE, FAN_FLANGES, line};
use crate::chance::Chance;
use glam::DAffine3;
use std::f64::consts::FRAC_PI_2;

/// One of the two stretches of casing that carry pipes and brackets.
#[derive(Clone, Copy)]
pub(super) struct Skin {
    /// [x, radius] of its outside.
    pub outer: &'static [[f64; 2]],
    /// From where to where things stand on it.
    pub x: [f64; 2],
    /// Degrees from and to, free of openings and boxes over the whole length.
    lanes: &'static [[f64; 2]],
    /// Where pipes may run around it: over and beside the flanges, where openings end before.
    pub rounds: &'static [f64],
    flanges: &'static [f64],
    /// A radius somewhere in the middle.
    pub radius: f64,
}

/// Openings of the fan's casing: middles and half the width, in degrees.
pub(super) const FAN_OPENINGS: ([f64; 2], f64) = ([90.0, 270.0], 24.0);
/// Openings of the core's casings.
pub(super) const CORE_OPENINGS: ([f64; 2], f64) = ([75.0, 285.0], 27.0);

/// The fan's casing and the core's.
pub(super) const SKINS: [Skin; 2] = [
    Skin {
        outer: &FAN_CASE,
        x: [-1.69, -1.02],
        lanes: &[
            [120.0, 154.0],
            [206.0, 240.0],
            [300.0, 341.0],
            [379.0, 420.0],
        ],
        rounds: &[
            -1.836, -1.802, -1.768, -1.734, -1.7, -1.07, -1.036, -1.002, -0.968,
        ],
        flanges: &FAN_FLANGES,
        radius: 1.5,
    },
    Skin {
        outer: &CORE_CASE,
        x: [-0.68, 1.6],
        lanes: &[[108.0, 252.0], [318.0, 402.0]],
        rounds: &[
            -0.702, -0.668, -0.634, -0.6, -0.566, -0.184, -0.15, -0.116, 0.246, 0.28, 0.816, 0.85,
            0.884, 1.416, 1.45, 1.484, 1.518, 1.552, 1.586,
        ],
        flanges: &CORE_FLANGES,
        radius: 0.7,
    },
];

/// Metres between neighbouring pipes.
const SPACING: f64 = 0.03;
/// What stands on a casing keeps this far from flanges.
const CLEAR: f64 = 0.055;

impl Skin {
    /// An angle in radians at which there is casing from end to end.
    pub fn angle(&self, chance: &mut Chance) -> f64 {
        let widths = self.lanes.iter().map(|[from, to]| to - from);
        let mut along = chance.between(0.0, widths.sum());
        for [from, to] in self.lanes {
            if along <= to - from {
                return (from + along).to_radians();
            }
            along -= to - from;
        }
        0.0
    }

    /// Angles in radians at which pipes can run side by side from end to end.
    pub fn angles(&self) -> Vec<f64> {
        let lanes = self.lanes.iter().flat_map(|lane| {
            let [from, to] = lane.map(f64::to_radians);
            let count = ((to - from) * self.radius / SPACING).floor();
            (0..count as usize).map(move |i| from + (to - from) * (i as f64 + 0.5) / count)
        });
        lanes.collect()
    }

    /// The place on the axis nearest to `x` that is clear of flanges.
    pub fn beside_flanges(&self, x: f64) -> f64 {
        let near = self
            .flanges
            .iter()
            .find(|flange| (x - *flange).abs() < CLEAR);
        near.map_or(x, |flange| flange + CLEAR.copysign(x - flange))
    }

    /// The frame of what stands on it: Y away from the casing, X rearwards along it.
    pub fn upright(&self, x: f64, angle: f64) -> DAffine3 {
        upright(self.outer, x, angle, 0.0)
    }
}

/// The frame of what stands on a casing: Y away from it, X rearwards along it; `height` metres above it.
pub(super) fn upright(outer: &[[f64; 2]], x: f64, angle: f64, height: f64) -> DAffine3 {
    let rise = line(outer, x + 0.005) - line(outer, x - 0.005);
    DAffine3::from_rotation_x(angle)
        * shifted(x, line(outer, x) + height)
        * DAffine3::from_rotation_z((rise / 0.01).atan())
}

/// Turns what lies along X to stand along Y.
pub(super) fn standing() -> DAffine3 {
    DAffine3::from_rotation_z(FRAC_PI_2)
}

/// Turns what lies along X to stand outwards at `x`.
pub(super) fn standing_at(x: f64) -> DAffine3 {
    shifted(x, 0.0) * standing()
}
