//! One drawn entity as the GPU sees it: 64 bytes, relative to no camera.
//!
//! The origin is split into two f32 (high and low parts), so a static entity is uploaded once however the camera moves,
//! and the shader's subtraction of the eye is still exact to about 48 bits. (Relative to the eye with two floats a
//! coordinate: Cozzi and Ring, *3D Engine Design for Virtual Globes*, 2011, section 5.4.)

use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};
use glam::{DAffine3, DVec3};

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
    /// What the high parts leave of the origin.
    pub origin_low: [f32; 3],
    /// Index into the materials.
    pub material: u32,
}

impl Instance {
    /// Packs a world transform, or `None` when one of its numbers does not fit an f32.
    pub fn new(world: &DAffine3, material: u32) -> Option<Self> {
        let m = world.matrix3;
        let (high, low) = split(world.translation);
        let row = |i: usize, high: f32| {
            [
                m.x_axis[i] as f32,
                m.y_axis[i] as f32,
                m.z_axis[i] as f32,
                high,
            ]
        };
        let instance = Self {
            row_x: row(0, high[0]),
            row_y: row(1, high[1]),
            row_z: row(2, high[2]),
            origin_low: low,
            material,
        };
        let rows = [instance.row_x, instance.row_y, instance.row_z];
        rows.as_flattened()
            .iter()
            .all(|v| v.is_finite())
            .then_some(instance)
    }
}

/// A point as the sum of two f32: the nearest f32, and the nearest f32 to what is left.
pub fn split(point: DVec3) -> ([f32; 3], [f32; 3]) {
    let high = point.as_vec3();
    let low = (point - high.as_dvec3()).as_vec3();
    (high.to_array(), low.to_array())
}

assert_layout!(Instance, "depth", "Instance", { row_x, row_y, row_z, origin_low, material });

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_kilometre_wide_world_at_earth_scale_keeps_its_micrometres() {
        let origin = DVec3::new(6_378_137.123_456_7, -0.000_001, 1e9 + 1e-3);
        let eye = origin + DVec3::new(3.25, -7.5, 0.125);
        let instance = Instance::new(&DAffine3::from_translation(origin), 0).unwrap();
        let (eye_high, eye_low) = split(eye);
        let highs = [instance.row_x[3], instance.row_y[3], instance.row_z[3]];
        for axis in 0..3 {
            // What the shader computes, in its order.
            let seen = (highs[axis] - eye_high[axis]) + (instance.origin_low[axis] - eye_low[axis]);
            assert!(
                (f64::from(seen) - (origin - eye)[axis]).abs() < 4e-6,
                "axis {axis}: {seen}"
            );
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        assert!(Instance::new(&DAffine3::from_scale(DVec3::splat(1e39)), 0).is_none());
        assert!(Instance::new(&DAffine3::from_scale(DVec3::splat(1e20)), 0).is_some());
    }
}
