//! Cameras: a pose in f64 and a projection. They look down -Z with +Y up; depth is reversed (1 at the near plane) and, in
//! perspective, without a far plane. What reaches the GPU is relative to the camera, so the view is a rotation alone.

use crate::bounds::Aabb;
use crate::frustum::{Frustum, Plane};
use glam::camera::rh::proj::directx;
use glam::{DMat3, DQuat, DVec3, Mat4};
use thiserror::Error;

/// How depth and size on the screen are related.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Projection {
    /// Far things look small; no far plane.
    Perspective {
        /// Full vertical angle of view in radians, between 0 and pi.
        fov_y: f64,
        /// Distance of the near plane in metres, above 0.
        near: f64,
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

/// A pose and a projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// How it projects.
    pub projection: Projection,
    /// Where it stands, in metres.
    pub position: DVec3,
    /// Turns -Z into the direction of view and +Y into the screen's up; of unit length.
    pub rotation: DQuat,
}

/// Why a camera cannot look. Each case names the number.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CameraError {
    /// NaN or infinity.
    #[error("{what} is {value}: it must be finite")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// It.
        value: String,
    },
    /// The near plane of a perspective camera lies at or behind the eye.
    #[error("near is {near} m: a perspective camera needs a near plane above 0")]
    Near {
        /// Metres.
        near: f64,
    },
    /// An angle of view one cannot project.
    #[error("fov_y is {fov_y} radians: it must lie between 0 and pi, both excluded")]
    FieldOfView {
        /// Radians.
        fov_y: f64,
    },
    /// An orthographic camera that sees nothing.
    #[error("height is {height} m: an orthographic camera needs a height above 0")]
    Height {
        /// Metres.
        height: f64,
    },
    /// An orthographic camera without depth.
    #[error("far is {far} m and near {near} m: far must lie beyond near")]
    Depth {
        /// Metres.
        near: f64,
        /// Metres.
        far: f64,
    },
    /// A rotation that is not of unit length.
    #[error("the rotation's length is {length}: it must be 1; normalise it")]
    Rotation {
        /// Its length.
        length: f64,
    },
    /// `look_at` with nothing to tell a direction from.
    #[error(
        "eye {eye} and target {target} coincide, or `up` {up} runs along the view: no direction follows from them"
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

/// By how much the frustum is opened, as a fraction: more than f32 on the GPU can be off, less than any pixel.
const OPENING: f64 = 1e-6;

impl Camera {
    /// A camera from its parts.
    ///
    /// # Errors
    /// Whatever [`Camera::validate`] finds.
    pub fn new(
        projection: Projection,
        position: DVec3,
        rotation: DQuat,
    ) -> Result<Self, CameraError> {
        let camera = Self {
            projection,
            position,
            rotation,
        };
        camera.validate()?;
        Ok(camera)
    }

    /// A camera at `eye` looking at `target`, with `up` upwards on the screen.
    ///
    /// # Errors
    /// [`CameraError::NoDirection`] if eye and target coincide or `up` is zero or along the view; and whatever
    /// [`Camera::validate`] finds.
    pub fn look_at(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        projection: Projection,
    ) -> Result<Self, CameraError> {
        for (what, value) in [("eye", eye), ("target", target), ("up", up)] {
            finite(what, &value, value.is_finite())?;
        }
        let none = CameraError::NoDirection { eye, target, up };
        let back = (eye - target).try_normalize().ok_or(none.clone())?;
        let up = up.try_normalize().ok_or(none.clone())?;
        let right = up.cross(back);
        if right.length() < 1e-9 {
            return Err(none);
        }
        let right = right.normalize();
        let axes = DMat3::from_cols(right, back.cross(right), back);
        Self::new(projection, eye, DQuat::from_mat3(&axes).normalize())
    }

    /// Refuses numbers that no picture can come of, naming them.
    ///
    /// # Errors
    /// One case of [`CameraError`] each.
    pub fn validate(&self) -> Result<(), CameraError> {
        finite("position", &self.position, self.position.is_finite())?;
        finite("rotation", &self.rotation, self.rotation.is_finite())?;
        let length = self.rotation.length();
        if (length - 1.0).abs() > 1e-6 {
            return Err(CameraError::Rotation { length });
        }
        match self.projection {
            Projection::Perspective { fov_y, near } => {
                finite("fov_y", &fov_y, fov_y.is_finite())?;
                finite("near", &near, near.is_finite())?;
                if fov_y <= 0.0 || fov_y >= std::f64::consts::PI {
                    return Err(CameraError::FieldOfView { fov_y });
                }
                if near <= 0.0 {
                    return Err(CameraError::Near { near });
                }
            }
            Projection::Orthographic { height, near, far } => {
                finite("height", &height, height.is_finite())?;
                finite("near", &near, near.is_finite())?;
                finite("far", &far, far.is_finite())?;
                if height <= 0.0 {
                    return Err(CameraError::Height { height });
                }
                if far <= near {
                    return Err(CameraError::Depth { near, far });
                }
            }
        }
        Ok(())
    }

    /// The direction of view.
    #[must_use]
    pub fn forward(&self) -> DVec3 {
        self.rotation * DVec3::NEG_Z
    }

    /// The direction that is up on the screen.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.rotation * DVec3::Y
    }

    /// The direction that is right on the screen.
    #[must_use]
    pub fn right(&self) -> DVec3 {
        self.rotation * DVec3::X
    }

    /// Distance of the near plane along the view, in metres.
    #[must_use]
    pub fn near(&self) -> f64 {
        match self.projection {
            Projection::Perspective { near, .. } | Projection::Orthographic { near, .. } => near,
        }
    }

    /// Turns camera-relative world coordinates into view coordinates: the view matrix without its translation, which is
    /// taken away in f64 before anything reaches the GPU.
    #[must_use]
    pub fn view_rotation(&self) -> Mat4 {
        Mat4::from_quat(self.rotation.conjugate().as_quat())
    }

    /// View to clip coordinates; depth 1 at the near plane and 0 at infinity (perspective) or the far plane (orthographic).
    /// `aspect` is width divided by height.
    #[must_use]
    pub fn projection_matrix(&self, aspect: f64) -> Mat4 {
        match self.projection {
            Projection::Perspective { fov_y, near } => {
                directx::perspective_infinite_reverse(fov_y as f32, aspect as f32, near as f32)
            }
            Projection::Orthographic { height, near, far } => {
                let (y, x) = ((height * 0.5) as f32, (height * aspect * 0.5) as f32);
                directx::orthographic(-x, x, -y, y, far as f32, near as f32)
            }
        }
    }

    /// What the camera sees at this aspect (width divided by height), opened by a millionth so that no rounding on the
    /// GPU brings a pixel in from outside.
    #[must_use]
    pub fn frustum(&self, aspect: f64) -> Frustum {
        let sides = self.sides(aspect);
        let forward = self.forward();
        let near = self.near();
        let mut planes: Vec<Plane> = sides.to_vec();
        let slack = |depth: f64| depth.abs() * OPENING + self.rounding();
        planes.push(Plane::through(
            self.position + forward * (near - slack(near)),
            forward,
        ));
        if let Projection::Orthographic { far, .. } = self.projection {
            planes.push(Plane::through(
                self.position + forward * (far + slack(far)),
                -forward,
            ));
        }
        Frustum::new(planes)
    }

    /// Whether the near plane may cut the box where it can be seen, or the eye is inside it. Conservative: the box is first
    /// widened a little, and a box close to the near rectangle may count as crossing. Such a box must count as visible,
    /// since a test against its clipped outline would say too little.
    #[must_use]
    pub fn crosses_near(&self, bounds: &Aabb, aspect: f64) -> bool {
        if bounds.is_empty() {
            return false;
        }
        let reach = (bounds.min - self.position)
            .abs()
            .max((bounds.max - self.position).abs());
        let near = self.near();
        let margin = reach.max_element() * OPENING + near.abs() * 1e-3 + self.rounding();
        let bounds = bounds.grown(DVec3::splat(margin));
        if bounds.contains(self.position)
            && matches!(self.projection, Projection::Perspective { .. })
        {
            return true;
        }
        let forward = self.forward();
        let sides = self.sides(aspect);
        let near_point = self.position + forward * near;
        let mut planes: Vec<Plane> = sides.to_vec();
        planes.push(Plane::through(near_point, -forward));
        if matches!(self.projection, Projection::Orthographic { .. }) {
            // The column before the near plane has no end; only what straddles the plane is cut by it.
            planes.push(Plane::through(near_point, forward));
        }
        let (centre, radius) = self.near_ball(aspect);
        bounds.distance(centre) <= radius && Frustum::new(planes).intersects(&bounds)
    }

    /// Distance in metres from the eye to the nearest of the box's eight corners.
    #[must_use]
    pub fn nearest_corner_distance(&self, bounds: &Aabb) -> f64 {
        let squared = bounds.corners().map(|c| c.distance_squared(self.position));
        squared.into_iter().fold(f64::INFINITY, f64::min).sqrt()
    }

    /// The four side planes, their normals inwards.
    fn sides(&self, aspect: f64) -> [Plane; 4] {
        let (right, up, forward) = (self.right(), self.up(), self.forward());
        let slack = self.rounding();
        match self.projection {
            Projection::Perspective { fov_y, .. } => {
                let y = (fov_y * 0.5).tan() * (1.0 + OPENING);
                let x = y * aspect;
                let side = |normal: DVec3| {
                    let normal = normal.normalize();
                    Plane::through(self.position - normal * slack, normal)
                };
                [
                    side(right + forward * x),
                    side(forward * x - right),
                    side(up + forward * y),
                    side(forward * y - up),
                ]
            }
            Projection::Orthographic { height, .. } => {
                let y = height * 0.5 * (1.0 + OPENING) + slack;
                let x = height * 0.5 * aspect * (1.0 + OPENING) + slack;
                [
                    Plane::through(self.position - right * x, right),
                    Plane::through(self.position + right * x, -right),
                    Plane::through(self.position - up * y, up),
                    Plane::through(self.position + up * y, -up),
                ]
            }
        }
    }

    /// The ball around what lies before the near plane and can be seen: around the eye in perspective, around the near
    /// rectangle otherwise. Centre and radius in metres.
    fn near_ball(&self, aspect: f64) -> (DVec3, f64) {
        let diagonal = (1.0 + aspect * aspect).sqrt() * (1.0 + OPENING);
        match self.projection {
            Projection::Perspective { fov_y, near } => {
                let corner = (fov_y * 0.5).tan() * diagonal;
                (self.position, near * (1.0 + corner * corner).sqrt())
            }
            Projection::Orthographic { height, near, .. } => (
                self.position + self.forward() * near,
                height * 0.5 * diagonal,
            ),
        }
    }

    /// How far, in metres, f64 arithmetic on planes through this camera's position may be off.
    fn rounding(&self) -> f64 {
        self.position.abs().max_element() * (16.0 * f64::EPSILON)
    }
}

fn finite(what: &'static str, value: &impl std::fmt::Display, ok: bool) -> Result<(), CameraError> {
    if ok {
        return Ok(());
    }
    let value = value.to_string();
    Err(CameraError::NotFinite { what, value })
}
