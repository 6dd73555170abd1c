//! Ranges of azimuths: what a camera sees, as directions in the plan.

use std::f64::consts::PI;

use glam::DVec2;

/// A range of directions in the plan, such as the horizontal field of view of a camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AzimuthRange {
    /// The middle direction, of any length.
    pub(crate) middle: DVec2,
    /// Half the angle of the range, radians, 0 to pi.
    pub(crate) half_angle: f64,
}

impl AzimuthRange {
    /// All directions.
    pub const ALL: Self = Self {
        middle: DVec2::X,
        half_angle: PI,
    };

    /// The directions within `half_angle` radians of a middle direction, on either side. `half_angle` is clamped to 0 to pi.
    #[must_use]
    pub fn around(middle: DVec2, half_angle: f64) -> Self {
        Self {
            middle,
            half_angle: half_angle.clamp(0.0, PI),
        }
    }
}
