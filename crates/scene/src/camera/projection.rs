//! Projections: how depth and size on the screen are related, and the matrices that say so. Depth is reversed: 1 at the near
//! plane, 0 at infinity or the far plane.

use super::{CameraError, finite};
use glam::camera::rh::proj::directx;
use glam::{DVec2, Mat4};

/// How depth and size on the screen are related.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Far things look small; no far plane.
    Perspective {
        /// Full vertical angle of view in radians, between 0 and pi.
        fov_y: f64,
        /// Distance of the near plane in metres, above 0.
        near: f64,
    },
    /// Perspective through a window whose middle does not lie on the line of view: an eye beside the middle of a screen. At
    /// distance `d` along the view the window spans `d * (shift.x - t * aspect)` to `d * (shift.x + t * aspect)` rightwards
    /// and `d * (shift.y - t)` to `d * (shift.y + t)` upwards, where `t` is `tan(fov_y / 2)`. No far plane.
    OffAxis {
        /// Full vertical angle in radians that the window would have on the axis, between 0 and pi.
        fov_y: f64,
        /// Distance of the near plane in metres, above 0.
        near: f64,
        /// Tangents (right, up) of the angles between the line of view and the window's middle; 0 is `Perspective`.
        shift: DVec2,
    },
    /// Everything keeps its size.
    Orthographic {
        /// Full height of what is seen, in metres.
        height: f64,
        /// Distance of the near plane along the view in metres; may be negative.
        near: f64,
        /// Distance of the far plane along the view in metres, beyond `near`.
        far: f64,
    },
}

impl Projection {
    /// Refuses numbers that no picture can come of.
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
        }
    }

    /// View to clip coordinates.
    pub(super) fn matrix(&self, aspect: f64) -> Mat4 {
        let perspective = |fov_y: f64, near: f64| {
            directx::perspective_infinite_reverse(fov_y as f32, aspect as f32, near as f32)
        };
        match *self {
            Self::Perspective { fov_y, near } => perspective(fov_y, near),
            Self::OffAxis { fov_y, near, shift } => {
                let mut matrix = perspective(fov_y, near);
                // What lies on the window's middle, shift times the depth off the axis, lands on 0; depth is -z here.
                matrix.z_axis.x = matrix.x_axis.x * shift.x as f32;
                matrix.z_axis.y = matrix.y_axis.y * shift.y as f32;
                matrix
            }
            Self::Orthographic { height, near, far } => {
                let (y, x) = ((height * 0.5) as f32, (height * aspect * 0.5) as f32);
                directx::orthographic(-x, x, -y, y, far as f32, near as f32)
            }
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
