//! A view: a camera and the image it makes, as the host and the GPU see it.

use antumbra_scene::{Aabb, Camera, Frustum, Projection};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Mat4};

use crate::instance::split;

/// Mirrors `View` of `shared/view.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct GpuView {
    clip_from_relative: [f32; 16],
    eye_high: [f32; 3],
    pixels_wide: f32,
    eye_low: [f32; 3],
    pixels_high: f32,
}

assert_layout!(GpuView, "depth", "View", { clip_from_relative, eye_high, pixels_wide, eye_low, pixels_high });

/// A view in one frame.
#[derive(Debug, Clone)]
pub struct ViewFrame {
    /// The camera.
    pub camera: Camera,
    /// Pixels wide and high.
    pub size: [u32; 2],
    /// What the camera sees, in world space.
    pub frustum: Frustum,
    /// Counts the cuts of this view: an answer asked before a cut says nothing after it.
    pub cuts: u64,
}

impl ViewFrame {
    /// A camera looking at an image of `size` pixels.
    pub fn new(camera: Camera, size: [u32; 2], cuts: u64) -> Self {
        let frustum = camera.frustum(aspect(size));
        Self {
            camera,
            size,
            frustum,
            cuts,
        }
    }

    /// Width over height.
    pub fn aspect(&self) -> f64 {
        aspect(self.size)
    }

    /// Turns world coordinates relative to the camera into clip coordinates.
    pub fn clip_from_relative(&self) -> Mat4 {
        self.camera.projection_matrix(self.aspect()) * self.camera.view_rotation()
    }

    /// What the shaders read.
    pub fn uniform(&self) -> GpuView {
        let clip_from_relative = self.clip_from_relative();
        let (eye_high, eye_low) = split(self.camera.position);
        GpuView {
            clip_from_relative: clip_from_relative.to_cols_array(),
            eye_high,
            pixels_wide: self.size[0] as f32,
            eye_low,
            pixels_high: self.size[1] as f32,
        }
    }

    /// How many pixels a length, in metres, covers at least wherever it lies in these bounds, seen from the side.
    pub fn pixels_of(&self, length: f64, bounds: &Aabb) -> f64 {
        let scale = self.pixels_a_metre();
        match self.camera.projection {
            Projection::Orthographic { .. } => length * scale,
            _ => {
                let middle = bounds.centre().distance(self.camera.position);
                length * scale / (middle + bounds.half_extents().length())
            }
        }
    }

    /// How many pixels a length across the line of sight, in metres, covers at most wherever it lies in these bounds; without end where some of
    /// them is beside or behind the eye.
    pub fn pixels_at_most(&self, length: f64, bounds: &Aabb) -> f64 {
        let scale = self.pixels_a_metre();
        match self.camera.projection {
            Projection::Orthographic { .. } => length * scale,
            _ => {
                let forward = self.camera.forward();
                let middle = forward.dot(bounds.centre() - self.camera.position);
                let nearest = middle - forward.abs().dot(bounds.half_extents());
                match nearest > 0.0 {
                    true => length * scale / nearest,
                    false => f64::INFINITY,
                }
            }
        }
    }

    /// Pixels a metre, at a distance of a metre or, in a parallel view, anywhere.
    fn pixels_a_metre(&self) -> f64 {
        f64::from(self.camera.projection_matrix(self.aspect()).y_axis.y)
            * 0.5
            * f64::from(self.size[1])
    }

    /// The camera's right, up and forward directions.
    pub fn axes(&self) -> [DVec3; 3] {
        [DVec3::X, DVec3::Y, DVec3::NEG_Z].map(|axis| self.camera.rotation * axis)
    }
}

fn aspect(size: [u32; 2]) -> f64 {
    f64::from(size[0].max(1)) / f64::from(size[1].max(1))
}
