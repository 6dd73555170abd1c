//! A view in one frame: a camera and the size of its image, for the host and for shaders.

use antumbra_scene::{Aabb, Camera, Frustum, Projection};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Mat4};

use crate::split_point::SplitPoint;

/// The view's uniform. Mirrors `View` of `shared/view.wgsl`.
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

impl GpuView {
    /// The view from `eye` by a matrix from world space relative to it, with an image of `size` pixels.
    pub(crate) fn new(clip_from_relative: Mat4, eye: DVec3, size: [u32; 2]) -> Self {
        let SplitPoint { high, low } = SplitPoint::new(eye);
        Self {
            clip_from_relative: clip_from_relative.to_cols_array(),
            eye_high: high,
            pixels_wide: size[0] as f32,
            eye_low: low,
            pixels_high: size[1] as f32,
        }
    }
}

/// A view in one frame.
#[derive(Debug, Clone)]
pub struct ViewFrame {
    /// The camera.
    pub camera: Camera,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The view frustum in world space.
    pub frustum: Frustum,
    /// Number of camera cuts of this view so far. Query results from before a cut are not valid after it.
    pub cuts: u64,
}

/// A camera's directions in world space, unit vectors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewAxes {
    /// To the right in the image.
    pub right: DVec3,
    /// Upwards in the image.
    pub up: DVec3,
    /// Into the image.
    pub forward: DVec3,
}

/// How large a metre is in an image.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PixelScale {
    /// Pixels a metre across the line of sight, where the [divisor](Camera::divisor) is 1: at least, anywhere in the image.
    pub least: f64,
    /// At most.
    pub most: f64,
    divides: DVec3,
    at_eye: f64,
}

impl PixelScale {
    /// The largest divisor within so many metres of the eye.
    pub fn most_divisor(&self, reach: f64) -> f64 {
        self.divides.length() * reach + self.at_eye
    }
}

impl ViewFrame {
    /// A view of a camera with an image of `size` pixels, width and height.
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

    /// The matrix from world coordinates relative to the camera to clip coordinates.
    pub fn clip_from_relative(&self) -> Mat4 {
        self.camera.clip_from_relative(self.aspect())
    }

    /// The uniform that shaders read.
    pub fn uniform(&self) -> GpuView {
        GpuView::new(self.clip_from_relative(), self.camera.position, self.size)
    }

    /// A lower bound of the pixels that a length, in metres, covers anywhere within these bounds, seen from the side.
    pub fn min_pixels(&self, length: f64, bounds: &Aabb) -> f64 {
        let scale = self.pixel_scale();
        let reach = bounds.centre().distance(self.camera.position) + bounds.half_extents().length();
        length * scale.least / scale.most_divisor(reach)
    }

    /// An upper bound of the pixels that a length across the line of sight, in metres, covers anywhere within these bounds; infinite where
    /// they are partly beside or behind the eye.
    pub fn max_pixels(&self, length: f64, bounds: &Aabb) -> f64 {
        let scale = self.pixel_scale();
        let centre = bounds.centre() - self.camera.position;
        let nearest = scale.divides.dot(centre) + scale.at_eye
            - scale.divides.abs().dot(bounds.half_extents());
        match nearest > 0.0 {
            true => length * scale.most / nearest,
            false => f64::INFINITY,
        }
    }

    /// How large a metre is in the image.
    pub(crate) fn pixel_scale(&self) -> PixelScale {
        let [least, most] = match self.camera.projection {
            Projection::Matrix(matrix) => matrix.pixels_a_metre(self.size),
            _ => {
                let scale = self.camera.projection_matrix(self.aspect()).y_axis.y;
                [f64::from(scale) * 0.5 * f64::from(self.size[1]); 2]
            }
        };
        let (divides, at_eye) = self.camera.divisor();
        PixelScale {
            least,
            most,
            divides,
            at_eye,
        }
    }

    /// The camera's directions in world space.
    pub fn axes(&self) -> ViewAxes {
        let [right, up, forward] =
            [DVec3::X, DVec3::Y, DVec3::NEG_Z].map(|axis| self.camera.rotation * axis);
        ViewAxes { right, up, forward }
    }
}

fn aspect(size: [u32; 2]) -> f64 {
    f64::from(size[0].max(1)) / f64::from(size[1].max(1))
}
