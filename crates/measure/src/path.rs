//! Camera paths: the poses at which strategies are measured. Orbits and flights are made from a few numbers and a seed; others are read from
//! files.
//!
//! +Y is up, lengths are in metres, and each pose is one frame.

use antumbra_scene::{Camera, CameraError, Projection};
use glam::{DQuat, DVec3};

use crate::MeasureError;

mod file;
mod flight;
mod orbit;

pub use file::{MAX_PATH_BYTES, MAX_POSES};
pub use flight::{BURST, Waypoint};
pub use orbit::Orbit;

/// The camera's pose in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The eye in world metres.
    pub position: DVec3,
    /// The camera's rotation, a unit quaternion; it looks down its -Z with +Y up.
    pub rotation: DQuat,
    /// Whether the camera jumps here instead of moving, so that no result of earlier frames is valid.
    pub cut: bool,
}

/// A named sequence of poses with one projection. It has at least one pose, and all numbers are finite.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraPath {
    name: String,
    projection: Projection,
    poses: Vec<Pose>,
}

impl CameraPath {
    /// A path from poses.
    ///
    /// # Errors
    /// [`MeasureError::Path`] for no poses or more than [`MAX_POSES`], a number that is not finite, a rotation that is no unit quaternion (the
    /// error has the pose's number), or a projection that is not valid.
    pub fn new(
        name: impl Into<String>,
        projection: Projection,
        poses: Vec<Pose>,
    ) -> Result<Self, MeasureError> {
        let name = name.into();
        match check(projection, &poses) {
            Ok(()) => Ok(Self {
                name,
                projection,
                poses,
            }),
            Err(problem) => Err(MeasureError::Path { name, problem }),
        }
    }

    /// Its name in tables: `orbit`, `flight`, or the file's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The projection of all poses.
    pub fn projection(&self) -> Projection {
        self.projection
    }

    /// The cameras of all poses, in order.
    pub fn cameras(&self) -> impl ExactSizeIterator<Item = Camera> + '_ {
        self.poses.iter().map(|pose| pose.camera(self.projection))
    }

    /// The camera at a pose; the first is 0.
    ///
    /// # Errors
    /// [`MeasureError::Path`] past the last pose.
    pub fn camera(&self, pose: usize) -> Result<Camera, MeasureError> {
        let missing = || MeasureError::Path {
            name: self.name.clone(),
            problem: format!("it has no pose {pose}"),
        };
        let pose = self.poses.get(pose).ok_or_else(missing)?;
        Ok(pose.camera(self.projection))
    }

    /// The poses, one a frame.
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }
}

impl Pose {
    /// The pose of an eye that looks at a target, with `up` upwards in the image. Without `up` it is +Y or, where that is the line of sight, -Z,
    /// as on a map.
    ///
    /// # Errors
    /// [`CameraError`] where eye and target coincide, `up` is 0 or along the line of sight, or a number is not finite.
    pub fn look_at(eye: DVec3, target: DVec3, up: Option<DVec3>) -> Result<Self, CameraError> {
        // The rotation does not depend on the projection, but a camera needs one.
        let any = Projection::Perspective {
            fov_y: 1.0,
            near: 1.0,
        };
        let camera = match up {
            Some(up) => Camera::look_at(eye, target, up, any),
            None => Camera::look_at(eye, target, DVec3::Y, any).or_else(|error| match error {
                CameraError::NoDirection { .. } => {
                    Camera::look_at(eye, target, DVec3::NEG_Z, any).map_err(|_| error)
                }
                other => Err(other),
            }),
        }?;
        Ok(Self {
            position: camera.position,
            rotation: camera.rotation,
            cut: false,
        })
    }

    /// The camera at this pose.
    pub fn camera(&self, projection: Projection) -> Camera {
        Camera {
            projection,
            position: self.position,
            rotation: self.rotation,
        }
    }
}

fn check(projection: Projection, poses: &[Pose]) -> Result<(), String> {
    if poses.is_empty() {
        return Err("it has no poses".to_owned());
    }
    if poses.len() > MAX_POSES {
        return Err(format!("{} poses are more than {MAX_POSES}", poses.len()));
    }
    // Checks the projection by itself, so that its error has no pose number.
    let resting = Pose {
        position: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        cut: false,
    };
    resting
        .camera(projection)
        .validate()
        .map_err(|e| e.to_string())?;
    poses.iter().enumerate().try_for_each(|(i, pose)| {
        pose.camera(projection)
            .validate()
            .map_err(|e| format!("pose {i}: {e}"))
    })
}
