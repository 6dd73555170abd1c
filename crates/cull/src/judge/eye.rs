//! The eye of a judged view: any matrix, and the point that positions are relative to.

use antumbra_scene::{Aabb, Camera, Frustum, frustum::Plane, is_invertible};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, DVec4, Mat4, Vec3};

use super::depth::{DepthRange, HostDepth};
use crate::split_point::SplitPoint;

/// The eye of a view in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eye {
    /// From world space relative to `position` to clip space, as wgpu has it: y upwards, depths of 0 to w. Perspective or parallel, on or off the axis, with any near plane and with a
    /// far plane or without.
    pub clip_from_relative: Mat4,
    /// What positions are subtracted from in f64 before the matrix is applied: the camera's position, or any point not far from what it sees.
    pub position: DVec3,
    /// Whether the camera jumped since the last frame: nothing that was found before is used.
    pub cut: bool,
    /// By how many pixels the image may shift until this frame's answers are used, where that is later: what is hidden is so by as much, and what crosses the image's edge is not. With 0, answers are about
    /// this very image. It makes what a moving camera uncovers rarer in answers that are late, and hides less.
    pub shift: f32,
    /// Which way the eye goes, where answers are used later.
    pub drift: Drift,
}

/// Which way an eye goes until answers are used. What is near then moves against it, and uncovers what is behind on one side: only there what is hidden must be so by some pixels, where [`Eye::shift`] asks for them
/// on all sides.
///
/// What is hidden stays so while the eye goes on that way, as long as nothing behind moves by more than these pixels relative to what is before it, and nothing that hides comes nearer than the near plane. That is true
/// of what one connected surface hides, and down to a pixel: between two that hide together, a gap may open. A small [`Eye::shift`] besides is for what lies between samples, and for an eye that turns or leaves
/// its way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// A direction in world space, of any length.
    pub way: Vec3,
    /// By how many pixels what is hidden may move relative to what hides it, along each axis of the image. More than a million are as many.
    pub pixels: f32,
}

impl Drift {
    /// An eye that stays where it is.
    pub const NONE: Self = Self {
        way: Vec3::ZERO,
        pixels: 0.0,
    };

    /// Why it is none.
    fn fault(&self) -> Option<String> {
        let is_right = self.way.is_finite() && self.pixels >= 0.0 && self.pixels.is_finite();
        (!is_right).then(|| {
            format!(
                "it drifts along {} by {} pixels: give finite numbers, and at least 0 pixels",
                self.way, self.pixels
            )
        })
    }

    /// The direction in clip space (x, y and w), the greatest coordinate of which is the pixels. In f64 no direction is too long and no matrix too large for it.
    fn in_clip_space(&self, clip_from_relative: &Mat4) -> Vec3 {
        let way = clip_from_relative.as_dmat4() * self.way.as_dvec3().extend(0.0);
        let way = DVec3::new(way.x, way.y, way.w);
        let greatest = way.abs().max_element();
        match greatest > 0.0 {
            true => (way / greatest * f64::from(self.pixels.min(MOST_PIXELS))).as_vec3(),
            false => Vec3::ZERO,
        }
    }
}

/// What drifts by more pixels than this may be anywhere in any image, and shaders have numbers for it.
const MOST_PIXELS: f32 = 1e6;

impl Eye {
    /// A matrix around a point, without a cut.
    pub const fn new(clip_from_relative: Mat4, position: DVec3) -> Self {
        Self {
            clip_from_relative,
            position,
            cut: false,
            shift: 0.0,
            drift: Drift::NONE,
        }
    }

    /// The eye of a camera of ours, with an image of `size` pixels. Its depth is [`DepthRange::Reversed`].
    pub fn of(camera: &Camera, size: [u32; 2]) -> Self {
        let aspect = f64::from(size[0].max(1)) / f64::from(size[1].max(1));
        Self::new(camera.clip_from_relative(aspect), camera.position)
    }

    /// Why it gives no image; `None` where it does.
    pub(super) fn fault(&self) -> Option<String> {
        if !self.position.is_finite() {
            return Some(format!(
                "its eye is at {}: give finite numbers",
                self.position
            ));
        }
        if !self.clip_from_relative.is_finite() {
            return Some(
                "its matrix holds numbers that are not finite: give finite ones".to_owned(),
            );
        }
        if !(self.shift >= 0.0 && self.shift.is_finite()) {
            return Some(format!(
                "its image shifts by {} pixels: give a finite number that is at least 0",
                self.shift
            ));
        }
        if let Some(fault) = self.drift.fault() {
            return Some(fault);
        }
        (!is_invertible(&self.clip_from_relative.as_dmat4())).then(|| {
            "its matrix is singular, so that points at different places look the same: give one that can be inverted".to_owned()
        })
    }

    /// The row of the matrix that is 0 on the near plane and positive in front of it.
    fn near_row(&self, range: DepthRange) -> DVec4 {
        let matrix = self.clip_from_relative.as_dmat4();
        match range {
            DepthRange::Reversed => matrix.row(3) - matrix.row(2),
            DepthRange::Forward => matrix.row(2),
        }
    }

    /// The view volume, opened a little: no rounding adds a pixel from outside.
    pub(super) fn frustum(&self) -> Frustum {
        let matrix = self.clip_from_relative.as_dmat4();
        let [x, y, z, w] = [0, 1, 2, 3].map(|row| matrix.row(row));
        let wider = w * (1.0 + OPENING);
        let rows = [
            wider + x,
            wider - x,
            wider + y,
            wider - y,
            z + w * OPENING,
            wider - z,
        ];
        let planes = rows.into_iter().filter_map(|row| {
            let length = row.truncate().length();
            // Without a far plane there is nothing to be beyond of.
            (length > 0.0).then(|| {
                let normal = row.truncate() / length;
                Plane {
                    normal,
                    offset: row.w / length - normal.dot(self.position),
                }
            })
        });
        Frustum::new(planes.collect())
    }

    /// Whether bounds reach the near plane, or what is beside the eye.
    pub(super) fn reaches_near(&self, bounds: &Aabb, range: DepthRange) -> bool {
        let centre = bounds.centre() - self.position;
        let half = bounds.half_extents();
        let reach = centre.abs() + half;
        let w = self.clip_from_relative.as_dmat4().row(3);
        [self.near_row(range), w].into_iter().any(|row| {
            let normal = row.truncate();
            let margin = OPENING * (normal.abs().dot(reach) + row.w.abs());
            normal.dot(centre) + row.w - normal.abs().dot(half) <= margin
        })
    }
}

/// By how much the view volume is opened, as a part of w.
const OPENING: f64 = 4e-6;

/// Mirrors `JudgedView` of `shared/judged.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct GpuJudgedView {
    clip_from_relative: [f32; 16],
    eye_high: [f32; 3],
    pixels_wide: f32,
    eye_low: [f32; 3],
    pixels_high: f32,
    towards: f32,
    depth_step: f32,
    pub count: u32,
    flags: u32,
    shift: f32,
    drift_x: f32,
    drift_y: f32,
    drift_w: f32,
}

assert_layout!(GpuJudgedView, "judge_first", "JudgedView", { clip_from_relative, eye_high, pixels_wide, eye_low, pixels_high, towards, depth_step, count, flags, shift, drift_x, drift_y, drift_w });

/// Bits of `GpuJudgedView::flags`.
pub(crate) const FORGET: u32 = 1;
pub(crate) const FRAME_LATE: u32 = 2;
pub(crate) const AT_MIDDLES: u32 = 4;
pub(crate) const CULL_UNKNOWN: u32 = 8;
pub(crate) const BOXES_ALONE: u32 = 16;
pub(crate) const ONE_LOOK: u32 = 32;
pub(crate) const WHOLE_BOXES: u32 = 64;

impl GpuJudgedView {
    pub fn new(eye: &Eye, size: [u32; 2], depth: HostDepth, count: u32, flags: u32) -> Self {
        let SplitPoint { high, low } = SplitPoint::new(eye.position);
        let drift = eye.drift.in_clip_space(&eye.clip_from_relative);
        Self {
            clip_from_relative: eye.clip_from_relative.to_cols_array(),
            eye_high: high,
            pixels_wide: size[0] as f32,
            eye_low: low,
            pixels_high: size[1] as f32,
            towards: depth.range.towards(),
            depth_step: depth.step(),
            count,
            flags,
            shift: eye.shift,
            drift_x: drift.x,
            drift_y: drift.y,
            drift_w: drift.z,
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::camera::rh::proj::directx;

    use super::*;

    fn in_clip_space(way: Vec3, pixels: f32) -> Vec3 {
        let projection = directx::perspective_infinite_reverse(0.9, 1.25, 0.1);
        Drift { way, pixels }.in_clip_space(&projection)
    }

    #[test]
    fn the_length_of_a_way_does_not_matter() {
        let way = Vec3::new(0.9, -0.6, -0.7);
        let expected = in_clip_space(way, 8.0);
        assert_eq!(expected.abs().max_element(), 8.0);
        for length in [1e-37, 1e-6, 1e6, 3.4e38] {
            let found = in_clip_space(way * length, 8.0);
            assert!(found.abs_diff_eq(expected, 1e-5), "{length:e}: {found}");
        }
        assert_eq!(in_clip_space(Vec3::ZERO, 8.0), Vec3::ZERO);
    }

    #[test]
    fn the_most_pixels_are_many_and_no_more_than_shaders_have_numbers_for() {
        for pixels in [1e6, 1e20, f32::MAX] {
            assert_eq!(in_clip_space(Vec3::X, pixels), Vec3::X * 1e6);
        }
    }
}
