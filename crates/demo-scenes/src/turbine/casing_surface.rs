//! The outer surface of the casings: places for pipes and brackets, clear of openings.

use super::assembly::shifted;
use super::plan::{CORE_CASE, CORE_FLANGES, FAN_CASE, FAN_FLANGES, radius_at};
use crate::random::Random;
use glam::DAffine3;
use std::f64::consts::FRAC_PI_2;

/// One of the two parts of the casing that carry pipes and brackets.
#[derive(Clone, Copy)]
pub(super) struct CasingSurface {
    /// Profile of its outside as [x, radius].
    pub outer: &'static [[f64; 2]],
    /// Axial range for parts.
    pub x: [f64; 2],
    /// Angular ranges in degrees that are free of openings and boxes over the whole length.
    lanes: &'static [[f64; 2]],
    /// Axial positions of pipes that run around: over and beside the flanges, where the openings have ended.
    pub rounds: &'static [f64],
    flanges: &'static [f64],
    /// A typical radius.
    pub radius: f64,
}

/// The two openings of a casing around the axis, in degrees.
#[derive(Clone, Copy)]
pub(super) struct OpeningAngles {
    /// Angles of the centres.
    pub middles: [f64; 2],
    /// Half the width of an opening.
    pub half_width: f64,
}

/// Openings of the fan's casing.
pub(super) const FAN_OPENINGS: OpeningAngles = OpeningAngles {
    middles: [90.0, 270.0],
    half_width: 24.0,
};
/// Openings of the core's casings.
pub(super) const CORE_OPENINGS: OpeningAngles = OpeningAngles {
    middles: [75.0, 285.0],
    half_width: 27.0,
};

/// The fan casing and the core casing.
pub(super) const CASING_SURFACES: [CasingSurface; 2] = [
    CasingSurface {
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
    CasingSurface {
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

/// Distance between neighbouring pipes, in metres.
const SPACING: f64 = 0.03;
/// Distance between parts and flanges, in metres.
const CLEAR: f64 = 0.055;

impl CasingSurface {
    /// A random angle in radians that is free of openings over the whole length.
    pub fn angle(&self, random: &mut Random) -> f64 {
        let widths = self.lanes.iter().map(|[from, to]| to - from);
        let mut along = random.between(0.0, widths.sum());
        for [from, to] in self.lanes {
            if along <= to - from {
                return (from + along).to_radians();
            }
            along -= to - from;
        }
        0.0
    }

    /// Angles in radians for pipes that run side by side over the whole length.
    pub fn angles(&self) -> Vec<f64> {
        let lanes = self.lanes.iter().flat_map(|lane| {
            let [from, to] = lane.map(f64::to_radians);
            let count = ((to - from) * self.radius / SPACING).floor();
            (0..count as usize).map(move |i| from + (to - from) * (i as f64 + 0.5) / count)
        });
        lanes.collect()
    }

    /// The axial position nearest to `x` that is clear of flanges.
    pub fn beside_flanges(&self, x: f64) -> f64 {
        let near = self
            .flanges
            .iter()
            .find(|flange| (x - *flange).abs() < CLEAR);
        near.map_or(x, |flange| flange + CLEAR.copysign(x - flange))
    }

    /// The transform of a part on the surface: Y away from the casing, X rearwards along it.
    pub fn upright(&self, x: f64, angle: f64) -> DAffine3 {
        upright(self.outer, x, angle, 0.0)
    }
}

/// The transform of a part `height` metres above a casing: Y away from it, X rearwards along it.
pub(super) fn upright(outer: &[[f64; 2]], x: f64, angle: f64, height: f64) -> DAffine3 {
    let rise = radius_at(outer, x + 0.005) - radius_at(outer, x - 0.005);
    DAffine3::from_rotation_x(angle)
        * shifted(x, radius_at(outer, x) + height)
        * DAffine3::from_rotation_z((rise / 0.01).atan())
}

/// The rotation from the X axis to the Y axis.
pub(super) fn standing() -> DAffine3 {
    DAffine3::from_rotation_z(FRAC_PI_2)
}

/// The rotation from the X axis to the Y axis at a position on the axis.
pub(super) fn standing_at(x: f64) -> DAffine3 {
    shifted(x, 0.0) * standing()
}
