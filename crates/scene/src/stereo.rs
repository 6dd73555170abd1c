//! Two eyes for one camera: parallel axes, and off-axis windows that coincide at one distance.
//!
//! Things at that distance appear in the screen's plane. There is no vertical parallax, which toed-in cameras would
//! have. The geometry is that of Paul Bourke, *Calculating Stereo Pairs*, 1999.

use crate::camera::{Camera, CameraError, Projection};
use glam::DVec2;
use thiserror::Error;

/// The distances of a stereo pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stereo {
    /// The interocular distance in metres, 0 or more.
    pub interocular: f64,
    /// The convergence distance along the view in metres, above 0: both eyes see the same rectangle there.
    pub convergence: f64,
}

/// Why a stereo pair is refused. Each case names the number and its range.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum StereoError {
    /// The interocular distance is negative or not finite.
    #[error("the interocular distance is {value} m: it must be finite, and 0 or more")]
    Interocular {
        /// Metres.
        value: f64,
    },
    /// The convergence distance is not above 0, or not finite.
    #[error("the convergence distance is {value} m: it must be finite and above 0")]
    Convergence {
        /// Metres.
        value: f64,
    },
    /// An orthographic camera: without perspective both eyes see the same.
    #[error(
        "an orthographic camera has no stereo pair: its image does not depend on its position beside its axis; use a perspective camera"
    )]
    Orthographic,
    /// The camera's projection is a matrix.
    #[error(
        "a camera with a matrix has no stereo pair that follows from it: give each eye its own camera"
    )]
    Matrix,
    /// The camera, or one of the eyes, is invalid.
    #[error(transparent)]
    Camera(#[from] CameraError),
}

impl Stereo {
    /// A stereo pair from its distances in metres.
    ///
    /// # Errors
    /// As for [`Stereo::validate`].
    pub fn new(interocular: f64, convergence: f64) -> Result<Self, StereoError> {
        let stereo = Self {
            interocular,
            convergence,
        };
        stereo.validate()?;
        Ok(stereo)
    }

    /// Refuses invalid distances.
    ///
    /// # Errors
    /// [`StereoError::Interocular`] below 0, [`StereoError::Convergence`] at 0 or below, and either for NaN and
    /// infinity.
    pub fn validate(&self) -> Result<(), StereoError> {
        let (interocular, convergence) = (self.interocular, self.convergence);
        if !interocular.is_finite() || interocular < 0.0 {
            return Err(StereoError::Interocular { value: interocular });
        }
        if !convergence.is_finite() || convergence <= 0.0 {
            return Err(StereoError::Convergence { value: convergence });
        }
        Ok(())
    }

    /// The left and the right eye of a camera. The camera is halfway between them. Both eyes have its rotation, its
    /// angle of view, its near plane and its own shift. With an interocular distance of 0 both are the camera itself.
    ///
    /// ```
    /// use antumbra_scene::{Camera, Projection, Stereo};
    /// use glam::DVec3;
    ///
    /// let projection = Projection::Perspective { fov_y: 0.8, near: 0.1 };
    /// let camera = Camera::look_at(DVec3::Z * 2.0, DVec3::ZERO, DVec3::Y, projection)?;
    /// let [left, right] = Stereo::new(0.064, 2.0)?.eyes(&camera)?;
    /// assert_eq!(left.position, DVec3::new(-0.032, 0.0, 2.0));
    /// assert_eq!(right.position, DVec3::new(0.032, 0.0, 2.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Stereo::validate`]; [`StereoError::Orthographic`] and [`StereoError::Matrix`]; [`StereoError::Camera`] for a camera that
    /// [`Camera::validate`] refuses, or distances so extreme that it refuses an eye.
    pub fn eyes(&self, camera: &Camera) -> Result<[Camera; 2], StereoError> {
        self.validate()?;
        camera.validate()?;
        let (fov_y, near, own) = match camera.projection {
            Projection::Perspective { fov_y, near } => (fov_y, near, DVec2::ZERO),
            Projection::OffAxis { fov_y, near, shift } => (fov_y, near, shift),
            Projection::Orthographic { .. } => return Err(StereoError::Orthographic),
            Projection::Matrix(_) => return Err(StereoError::Matrix),
        };
        if self.interocular == 0.0 {
            return Ok([*camera; 2]);
        }
        let aside = self.interocular * 0.5;
        let shift = DVec2::X * (aside / self.convergence);
        // The right eye is to the right of the camera. Its window keeps its place, so it is to the left of the eye.
        let eye = |side: f64| {
            Camera::new(
                Projection::OffAxis {
                    fov_y,
                    near,
                    shift: own - shift * side,
                },
                camera.position + camera.right() * (aside * side),
                camera.rotation,
            )
        };
        Ok([eye(-1.0)?, eye(1.0)?])
    }
}
