//! Cameras: a pose in f64 and a projection. They look down -Z with +Y up; depth is reversed (1 at the near plane) and, in
//! perspective, without a far plane. What reaches the GPU is relative to the camera, so the view is a rotation alone.

mod projection;

pub use projection::Projection;

use crate::bounds::Aabb;
use crate::frustum::{Frustum, Plane};
use glam::{DMat3, DQuat, DVec2, DVec3, Mat4};
use thiserror::Error;

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
        self.projection.validate()
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
            Projection::Perspective { near, .. }
            | Projection::OffAxis { near, .. }
            | Projection::Orthographic { near, .. } => near,
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
        self.projection.matrix(aspect)
    }

    /// What the camera sees at this aspect (width divided by height), opened by a millionth so that no rounding on the
    /// GPU brings a pixel in from outside.
    #[must_use]
    pub fn frustum(&self, aspect: f64) -> Frustum {
        self.window(aspect, DVec2::NEG_ONE, DVec2::ONE)
    }

    /// What it sees through a part of its image, opened likewise: from `low` to `high` in shares of half the image's width and height from
    /// its middle, -1 to 1, rightwards and upwards.
    #[must_use]
    pub fn window(&self, aspect: f64, low: DVec2, high: DVec2) -> Frustum {
        let sides = self.sides(aspect, low, high);
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
        let parallel = matches!(self.projection, Projection::Orthographic { .. });
        if bounds.contains(self.position) && !parallel {
            return true;
        }
        let forward = self.forward();
        let sides = self.sides(aspect, DVec2::NEG_ONE, DVec2::ONE);
        let near_point = self.position + forward * near;
        let mut planes: Vec<Plane> = sides.to_vec();
        planes.push(Plane::through(near_point, -forward));
        if parallel {
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

    /// The four planes at the sides of a part of the image, their normals inwards.
    fn sides(&self, aspect: f64, low: DVec2, high: DVec2) -> [Plane; 4] {
        let (right, up) = (self.right(), self.up());
        let slack = self.rounding();
        match self.projection {
            Projection::Perspective { fov_y, .. } => {
                self.pyramid(fov_y, DVec2::ZERO, aspect, (low, high))
            }
            Projection::OffAxis { fov_y, shift, .. } => {
                self.pyramid(fov_y, shift, aspect, (low, high))
            }
            Projection::Orthographic { height, .. } => {
                let y = height * 0.5 * (1.0 + OPENING) + slack;
                let x = height * 0.5 * aspect * (1.0 + OPENING) + slack;
                [
                    Plane::through(self.position + right * (x * low.x), right),
                    Plane::through(self.position + right * (x * high.x), -right),
                    Plane::through(self.position + up * (y * low.y), up),
                    Plane::through(self.position + up * (y * high.y), -up),
                ]
            }
        }
    }

    /// The sides of what is seen through a part of a window whose middle lies off the axis by these tangents.
    fn pyramid(
        &self,
        fov_y: f64,
        shift: DVec2,
        aspect: f64,
        (low, high): (DVec2, DVec2),
    ) -> [Plane; 4] {
        let (right, up, forward) = (self.right(), self.up(), self.forward());
        let slack = self.rounding();
        let y = (fov_y * 0.5).tan() * (1.0 + OPENING);
        // A number on the GPU is off by a part of itself, so a window far off the axis is opened by more.
        let half = DVec2::new(y * aspect, y) + shift.abs() * OPENING;
        let (low, high) = (-half * low - shift, half * high + shift);
        let side = |normal: DVec3| {
            let normal = normal.normalize();
            Plane::through(self.position - normal * slack, normal)
        };
        [
            side(right + forward * low.x),
            side(forward * high.x - right),
            side(up + forward * low.y),
            side(forward * high.y - up),
        ]
    }

    /// The ball around what lies before the near plane and can be seen: around the eye in perspective, up to the window's
    /// farthest corner; around the near rectangle otherwise. Centre and radius in metres.
    fn near_ball(&self, aspect: f64) -> (DVec3, f64) {
        let around_eye = |fov_y: f64, shift: DVec2, near: f64| {
            let half = DVec2::new(aspect, 1.0) * (fov_y * 0.5).tan();
            let corner = (shift.abs() + half) * (1.0 + OPENING);
            (self.position, near * (1.0 + corner.length_squared()).sqrt())
        };
        match self.projection {
            Projection::Perspective { fov_y, near } => around_eye(fov_y, DVec2::ZERO, near),
            Projection::OffAxis { fov_y, near, shift } => around_eye(fov_y, shift, near),
            Projection::Orthographic { height, near, .. } => {
                let diagonal = (1.0 + aspect * aspect).sqrt() * (1.0 + OPENING);
                (
                    self.position + self.forward() * near,
                    height * 0.5 * diagonal,
                )
            }
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
