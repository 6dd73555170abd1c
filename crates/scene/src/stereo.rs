//! Two eyes for one camera: parallel axes, and windows off the axes that coincide at one distance. Where they do, a thing lies
//! in the screen's plane; nothing is higher in one eye than in the other, which turned-in ("toed-in") cameras would give.
//! (The geometry of Paul Bourke, *Calculating Stereo Pairs*, 1999.)

use crate::camera::{Camera, CameraError, Projection};
use glam::DVec2;
use thiserror::Error;

/// How far apart two eyes are, and where they look at the same window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stereo {
    /// Distance between the eyes in metres, 0 or more.
    pub interocular: f64,
    /// Distance along the view in metres, above 0, at which both eyes see the same rectangle.
    pub convergence: f64,
}

/// Why there are no two eyes. Each case names the number and its range.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum StereoError {
    /// A distance between the eyes that cannot be.
    #[error("the interocular distance is {value} m: it must be finite, and 0 or more")]
    Interocular {
        /// Metres.
        value: f64,
    },
    /// A distance at which no window can stand.
    #[error("the convergence distance is {value} m: it must be finite and above 0")]
    Convergence {
        /// Metres.
        value: f64,
    },
    /// Without perspective both eyes see the same.
    #[error(
        "an orthographic camera has no eyes: what it sees does not depend on where it stands beside its axis; take a perspective one"
    )]
    Orthographic,
    /// The camera between the eyes cannot look, or an eye could not.
    #[error(transparent)]
    Camera(#[from] CameraError),
}

impl Stereo {
    /// Two eyes from their distances in metres.
    ///
    /// # Errors
    /// Whatever [`Stereo::validate`] finds.
    pub fn new(interocular: f64, convergence: f64) -> Result<Self, StereoError> {
        let stereo = Self {
            interocular,
            convergence,
        };
        stereo.validate()?;
        Ok(stereo)
    }

    /// Refuses distances that no two eyes can have.
    ///
    /// # Errors
    /// [`StereoError::Interocular`] below 0, [`StereoError::Convergence`] at 0 or below, and either for NaN and infinity.
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

    /// The left and the right eye of a camera, which stands in the middle between them. They are turned as it is, and keep its
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
    /// What [`Stereo::validate`] finds; [`StereoError::Orthographic`]; [`StereoError::Camera`] for a camera that
    /// [`Camera::validate`] refuses, or distances so extreme that an eye is one.
    pub fn eyes(&self, camera: &Camera) -> Result<[Camera; 2], StereoError> {
        self.validate()?;
        camera.validate()?;
        let (fov_y, near, own) = match camera.projection {
            Projection::Perspective { fov_y, near } => (fov_y, near, DVec2::ZERO),
            Projection::OffAxis { fov_y, near, shift } => (fov_y, near, shift),
            Projection::Orthographic { .. } => return Err(StereoError::Orthographic),
        };
        if self.interocular == 0.0 {
            return Ok([*camera; 2]);
        }
        let aside = self.interocular * 0.5;
        let shift = DVec2::X * (aside / self.convergence);
        // The right eye stands to the right, and its window stays where it was: to the left of it.
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
