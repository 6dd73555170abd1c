//! Why a camera is refused.

use glam::DVec3;
use thiserror::Error;

/// Why a camera is refused. Each case names the number.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CameraError {
    /// A number is NaN or infinite.
    #[error("{what} is {value}: it must be finite")]
    NotFinite {
        /// The name of the number.
        what: &'static str,
        /// The number as given.
        value: String,
    },
    /// The near plane of a perspective camera is at or behind the eye.
    #[error("near is {near} m: a perspective camera needs a near plane above 0")]
    Near {
        /// Metres.
        near: f64,
    },
    /// The angle of view is not between 0 and pi.
    #[error("fov_y is {fov_y} radians: it must lie between 0 and pi, both excluded")]
    FieldOfView {
        /// Radians.
        fov_y: f64,
    },
    /// The height of an orthographic camera is not above 0.
    #[error("height is {height} m: an orthographic camera needs a height above 0")]
    Height {
        /// Metres.
        height: f64,
    },
    /// The far plane of an orthographic camera is not beyond the near plane.
    #[error("far is {far} m and near {near} m: far must lie beyond near")]
    Depth {
        /// Metres.
        near: f64,
        /// Metres.
        far: f64,
    },
    /// The matrix cannot be inverted.
    #[error(
        "the matrix is singular, so that points at different places look the same: give one that can be inverted"
    )]
    Singular,
    /// The matrix exchanges right and left, or up and down.
    #[error(
        "the matrix shows a mirror image, in which front faces turn their backs: mirror the scene's transforms instead, or flip the image afterwards"
    )]
    Mirrored,
    /// The rotation is not of unit length.
    #[error("the rotation's length is {length}: it must be 1; normalise it")]
    Rotation {
        /// The length of the quaternion.
        length: f64,
    },
    /// `look_at` gives no direction.
    #[error(
        "eye {eye} and target {target} coincide, or `up` {up} is parallel to the view: they give no direction"
    )]
    NoDirection {
        /// Metres.
        eye: DVec3,
        /// Metres.
        target: DVec3,
        /// Any length.
        up: DVec3,
    },
}

/// Refuses a value that is not finite.
pub(super) fn finite(
    what: &'static str,
    value: &impl std::fmt::Display,
    ok: bool,
) -> Result<(), CameraError> {
    if ok {
        return Ok(());
    }
    let value = value.to_string();
    Err(CameraError::NotFinite { what, value })
}
