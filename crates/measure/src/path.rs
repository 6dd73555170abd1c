//! Camera paths: the poses at which strategies are measured. Orbits and flights come out of a few numbers and a seed, others out of a file.
//!
//! +Y is up, metres are the unit, and each pose is one frame.

use glam::{DMat3, DQuat, DVec3};

use crate::MeasureError;

mod file;
mod flight;
mod orbit;

pub use file::{MAX_PATH_BYTES, MAX_POSES};
pub use orbit::Orbit;

/// How the camera sees. Depth is reversed; a perspective has no far plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Nearer is larger.
    Perspective {
        /// The vertical field of view in radians, inside 0 to pi.
        fov_y: f64,
        /// The near plane's distance in metres, above 0.
        near: f64,
    },
    /// Near and far are drawn at one size.
    Orthographic {
        /// The height of the picture in metres, above 0.
        height: f64,
        /// The near plane's distance in metres.
        near: f64,
        /// The far plane's distance in metres, beyond `near`.
        far: f64,
    },
}

/// Where the camera stands in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The eye in world metres.
    pub position: DVec3,
    /// The camera's rotation, a unit quaternion; it looks down its -Z with +Y up.
    pub rotation: DQuat,
    /// Whether the camera jumps here instead of moving: nothing of the previous frame may be used.
    pub cut: bool,
}

/// A named row of poses and the projection they share. At least one pose; every number finite.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    name: String,
    projection: Projection,
    poses: Vec<Pose>,
}

impl Path {
    /// A path of your own.
    ///
    /// # Errors
    /// No poses or more than [`MAX_POSES`], a number that is not finite, a rotation that is no unit quaternion (each named by pose number), or
    /// a projection that cannot be drawn.
    pub fn new(
        name: impl Into<String>,
        projection: Projection,
        poses: Vec<Pose>,
    ) -> Result<Self, MeasureError> {
        let name = name.into();
        match check(&projection, &poses) {
            Ok(()) => Ok(Self {
                name,
                projection,
                poses,
            }),
            Err(problem) => Err(MeasureError::Path { name, problem }),
        }
    }

    /// What tables call it: `orbit`, `flight`, or the file's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The projection of all poses.
    pub fn projection(&self) -> Projection {
        self.projection
    }

    /// The poses, one a frame.
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }
}

impl Pose {
    /// The eye looking at a target, +Y up or as near to it as the direction allows; None when they coincide or a number is not finite.
    pub fn look_at(eye: DVec3, target: DVec3) -> Option<Self> {
        let forward = direction(eye, target)?;
        // Straight up or down, +Y says nothing: -Z is then the top of the picture, as on a map.
        let up = if forward.cross(DVec3::Y).length() > 1e-6 {
            DVec3::Y
        } else {
            DVec3::NEG_Z
        };
        Self::look_at_with_up(eye, target, up)
    }

    /// The eye looking at a target with an `up` of any length; None when they coincide, `up` lies along the line of sight, or a number is not
    /// finite.
    pub fn look_at_with_up(eye: DVec3, target: DVec3, up: DVec3) -> Option<Self> {
        let forward = direction(eye, target)?;
        let right = forward.cross(direction(DVec3::ZERO, up)?);
        if right.length() < 1e-9 {
            return None;
        }
        let right = right.normalize();
        let axes = DMat3::from_cols(right, right.cross(forward), -forward);
        Some(Self {
            position: eye,
            rotation: DQuat::from_mat3(&axes).normalize(),
            cut: false,
        })
    }

    /// The unit vector of sight.
    pub fn forward(&self) -> DVec3 {
        self.rotation * DVec3::NEG_Z
    }
}

/// From one point towards another, of length 1; safe at lengths whose squares are not.
fn direction(from: DVec3, to: DVec3) -> Option<DVec3> {
    let way = to - from;
    let largest = way.abs().max_element();
    (from.is_finite() && way.is_finite() && largest > 0.0).then(|| (way / largest).normalize())
}

fn check(projection: &Projection, poses: &[Pose]) -> Result<(), String> {
    match *projection {
        Projection::Perspective { fov_y, near } => {
            if !(fov_y > 0.0 && fov_y < std::f64::consts::PI) {
                return Err(format!(
                    "a field of view of {fov_y} radians is not between 0 and pi"
                ));
            }
            if !(near > 0.0 && near.is_finite()) {
                return Err(format!("a near plane at {near} m is not above 0"));
            }
        }
        Projection::Orthographic { height, near, far } => {
            if !(height > 0.0 && height.is_finite()) {
                return Err(format!("a picture {height} m high is not above 0"));
            }
            if !(near.is_finite() && far.is_finite() && near < far) {
                return Err(format!(
                    "a far plane at {far} m is not beyond the near plane at {near} m"
                ));
            }
        }
    }
    if poses.is_empty() {
        return Err("it has no poses".to_owned());
    }
    if poses.len() > MAX_POSES {
        return Err(format!("{} poses are more than {MAX_POSES}", poses.len()));
    }
    for (i, pose) in poses.iter().enumerate() {
        if !pose.position.is_finite() {
            return Err(format!(
                "pose {i} stands at {}, which is not finite",
                pose.position
            ));
        }
        if !is_unit(pose.rotation) {
            return Err(format!(
                "pose {i} has the rotation {}, which is no unit quaternion",
                pose.rotation
            ));
        }
    }
    Ok(())
}

/// Whether a rotation rotates and does nothing else; a NaN does not.
fn is_unit(rotation: DQuat) -> bool {
    (0.999_999..=1.000_001).contains(&rotation.length_squared())
}
