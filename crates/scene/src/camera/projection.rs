//! Projections and their matrices. Depth is reversed: 1 at the near plane, 0 at infinity or at the far plane.

use super::clip_matrix::ClipMatrix;
use super::error::{CameraError, finite};
use glam::camera::rh::proj::directx;
use glam::{DVec2, Mat4};

/// A projection from view to clip coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Perspective, without a far plane.
    Perspective {
        /// The full vertical angle of view in radians, between 0 and pi.
        fov_y: f64,
        /// The distance of the near plane in metres, above 0.
        near: f64,
    },
    /// Perspective through a window whose centre is off the view axis, as for an eye beside the centre of a screen.
    /// No far plane.
    ///
    /// At distance `d` along the view direction the window spans `d * (shift.x - t * aspect)` to `d * (shift.x + t *
    /// aspect)` rightwards and `d * (shift.y - t)` to `d * (shift.y + t)` upwards, where `t` is `tan(fov_y / 2)`.
    OffAxis {
        /// The full vertical angle of the window in radians if it were on the axis, between 0 and pi.
        fov_y: f64,
        /// The distance of the near plane in metres, above 0.
        near: f64,
        /// Tangents (right, up) of the angles between the view axis and the window's centre. Zero gives
        /// `Perspective`.
        shift: DVec2,
    },
    /// Parallel projection.
    Orthographic {
        /// The full height of the view volume in metres.
        height: f64,
        /// The distance of the near plane along the view direction in metres. It may be negative.
        near: f64,
        /// The distance of the far plane along the view direction in metres, beyond `near`.
        far: f64,
    },
    /// Any other, as a matrix. It knows its own aspect: that of the image is not used.
    Matrix(ClipMatrix),
}

impl Projection {
    /// Refuses numbers that give no image.
    pub(super) fn validate(&self) -> Result<(), CameraError> {
        match *self {
            Self::Perspective { fov_y, near } => perspective(fov_y, near),
            Self::OffAxis { fov_y, near, shift } => {
                finite("shift", &shift, shift.is_finite())?;
                perspective(fov_y, near)
            }
            Self::Orthographic { height, near, far } => {
                finite("height", &height, height.is_finite())?;
                finite("near", &near, near.is_finite())?;
                finite("far", &far, far.is_finite())?;
                if height <= 0.0 {
                    return Err(CameraError::Height { height });
                }
                if far <= near {
                    return Err(CameraError::Depth { near, far });
                }
                Ok(())
            }
            Self::Matrix(matrix) => matrix.validate(),
        }
    }

    /// The projection from view to clip coordinates.
    pub(super) fn matrix(&self, aspect: f64) -> Mat4 {
        let perspective = |fov_y: f64, near: f64| {
            directx::perspective_infinite_reverse(fov_y as f32, aspect as f32, near as f32)
        };
        match *self {
            Self::Perspective { fov_y, near } => perspective(fov_y, near),
            Self::OffAxis { fov_y, near, shift } => {
                let mut matrix = perspective(fov_y, near);
                // A point on the line through the window's centre is off the axis by shift times its depth, and must
                // project to 0. The depth is -z here.
                matrix.z_axis.x = matrix.x_axis.x * shift.x as f32;
                matrix.z_axis.y = matrix.y_axis.y * shift.y as f32;
                matrix
            }
            Self::Orthographic { height, near, far } => {
                let (y, x) = ((height * 0.5) as f32, (height * aspect * 0.5) as f32);
                directx::orthographic(-x, x, -y, y, far as f32, near as f32)
            }
            Self::Matrix(matrix) => matrix.matrix().as_mat4(),
        }
    }
}

fn perspective(fov_y: f64, near: f64) -> Result<(), CameraError> {
    finite("fov_y", &fov_y, fov_y.is_finite())?;
    finite("near", &near, near.is_finite())?;
    if fov_y <= 0.0 || fov_y >= std::f64::consts::PI {
        return Err(CameraError::FieldOfView { fov_y });
    }
    if near <= 0.0 {
        return Err(CameraError::Near { near });
    }
    Ok(())
}
