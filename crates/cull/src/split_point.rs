//! A point as the sum of two f32 a coordinate: about 48 bits, so that a shader's subtraction of the eye is nearly exact. (Cozzi and Ring, *3D
//! Engine Design for Virtual Globes*, 2011, section 5.4.)

use glam::DVec3;

/// A point as the sum of two f32 a coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SplitPoint {
    /// The nearest f32.
    pub high: [f32; 3],
    /// The nearest f32 to the remainder.
    pub low: [f32; 3],
}

impl SplitPoint {
    /// Splits a point.
    pub fn new(point: DVec3) -> Self {
        let high = point.as_vec3();
        let low = (point - high.as_dvec3()).as_vec3();
        Self {
            high: high.to_array(),
            low: low.to_array(),
        }
    }
}
