//! The instance data of an entity: 64 bytes, independent of the camera.
//!
//! Each coordinate of the origin is split into two f32, a high and a low part. A static entity is uploaded once, however the camera moves, and
//! the shader's subtraction of the eye is exact to about 48 bits. (Rendering relative to the eye with two floats a coordinate: Cozzi and
//! Ring, *3D Engine Design for Virtual Globes*, 2011, section 5.4.)

use antumbra_cull::SplitPoint;
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};
use glam::DAffine3;

/// An entity's transform and material. Mirrors `Instance` of `shared/instance.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Instance {
    /// Row x of the linear part, and the high part of the origin's x.
    pub row_x: [f32; 4],
    /// Row y, likewise.
    pub row_y: [f32; 4],
    /// Row z, likewise.
    pub row_z: [f32; 4],
    /// The low part of the origin.
    pub origin_low: [f32; 3],
    /// Index into the materials.
    pub material: u32,
}

impl Instance {
    /// Packs a world transform that [fits](Self::misfit).
    pub fn new(world: &DAffine3, material: u32) -> Self {
        let m = world.matrix3;
        let SplitPoint { high, low } = SplitPoint::new(world.translation);
        let row = |i: usize, high: f32| {
            [
                m.x_axis[i] as f32,
                m.y_axis[i] as f32,
                m.z_axis[i] as f32,
                high,
            ]
        };
        Self {
            row_x: row(0, high[0]),
            row_y: row(1, high[1]),
            row_z: row(2, high[2]),
            origin_low: low,
            material,
        }
    }

    /// The first number of a world transform that is too large for an f32, if there is one.
    pub fn misfit(world: &DAffine3) -> Option<f64> {
        let numbers = world.to_cols_array();
        let fits = |number: &f64| (*number as f32).is_finite();
        numbers.into_iter().find(|number| !fits(number))
    }
}

assert_layout!(Instance, "depth", "Instance", { row_x, row_y, row_z, origin_low, material });

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_kilometre_wide_world_at_earth_scale_keeps_its_micrometres() {
        let origin = DVec3::new(6_378_137.123_456_7, -0.000_001, 1e9 + 1e-3);
        let eye = origin + DVec3::new(3.25, -7.5, 0.125);
        let instance = Instance::new(&DAffine3::from_translation(origin), 0);
        let eye_parts = SplitPoint::new(eye);
        let highs = [instance.row_x[3], instance.row_y[3], instance.row_z[3]];
        for (axis, high) in highs.into_iter().enumerate() {
            // What the shader computes, in its order.
            let seen =
                (high - eye_parts.high[axis]) + (instance.origin_low[axis] - eye_parts.low[axis]);
            assert!(
                (f64::from(seen) - (origin - eye)[axis]).abs() < 4e-6,
                "axis {axis}: {seen}"
            );
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let misfit = |scale: f64| Instance::misfit(&DAffine3::from_scale(DVec3::splat(scale)));
        assert_eq!(misfit(1e39), Some(1e39));
        assert_eq!(misfit(1e20), None);
    }
}
