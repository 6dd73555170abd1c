//! Cameras: a pose in f64 and a projection.
//!
//! A camera looks down -Z, with +Y up. Depth is reversed: 1 at the near plane. A perspective camera has no far plane. A projection may also be
//! [any matrix](ClipMatrix).
//! Coordinates on the GPU are relative to the camera, so the view matrix is a rotation.

mod by_matrix;
mod clip_matrix;
mod error;
mod projection;

pub use clip_matrix::{ClipMatrix, is_invertible};
pub use error::CameraError;
pub use projection::Projection;

use crate::bounds::Aabb;
use crate::frustum::{Frustum, Plane};
use clip_matrix::turned;
use error::finite;
use glam::{DMat3, DMat4, DQuat, DVec2, DVec3, Mat4};

/// A camera: a pose and a projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The projection.
    pub projection: Projection,
    /// The position in the world, in metres.
    pub position: DVec3,
    /// The rotation from camera to world axes: it maps -Z to the view direction and +Y to the screen's up. Unit
    /// length.
    pub rotation: DQuat,
}

/// The fraction by which the frustum is widened: more than the f32 error on the GPU, less than any pixel.
const OPENING: f64 = 1e-6;

impl Camera {
    /// A camera from its parts.
    ///
    /// # Errors
    /// As for [`Camera::validate`].
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

    /// A camera at `eye` that looks at `target`, with `up` upwards on the screen.
    ///
    /// # Errors
    /// [`CameraError::NoDirection`] if eye and target coincide, or if `up` is zero or parallel to the view direction;
    /// and as for [`Camera::validate`].
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

    /// Refuses numbers that give no image.
    ///
    /// # Errors
    /// One case of [`CameraError`] per number.
    pub fn validate(&self) -> Result<(), CameraError> {
        finite("position", &self.position, self.position.is_finite())?;
        finite("rotation", &self.rotation, self.rotation.is_finite())?;
        let length = self.rotation.length();
        if (length - 1.0).abs() > 1e-6 {
            return Err(CameraError::Rotation { length });
        }
        self.projection.validate()
    }

    /// The view direction, a unit vector.
    #[must_use]
    pub fn forward(&self) -> DVec3 {
        self.rotation * DVec3::NEG_Z
    }

    /// The up direction of the screen, a unit vector.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.rotation * DVec3::Y
    }

    /// The right direction of the screen, a unit vector.
    #[must_use]
    pub fn right(&self) -> DVec3 {
        self.rotation * DVec3::X
    }

    /// The distance of the near plane along the view direction, in metres.
    #[must_use]
    pub fn near(&self) -> f64 {
        match self.projection {
            Projection::Perspective { near, .. }
            | Projection::OffAxis { near, .. }
            | Projection::Orthographic { near, .. } => near,
            Projection::Matrix(_) => {
                let plane = self.near_plane();
                -plane.distance(self.position) / plane.normal.dot(self.forward())
            }
        }
    }

    /// The near plane; what is in front of it is inside.
    #[must_use]
    pub fn near_plane(&self) -> Plane {
        match self.projection {
            Projection::Perspective { near, .. }
            | Projection::OffAxis { near, .. }
            | Projection::Orthographic { near, .. } => {
                let forward = self.forward();
                Plane::through(self.position + forward * near, forward)
            }
            Projection::Matrix(matrix) => self.plane(matrix.near_row()).unwrap_or(Plane {
                normal: self.forward(),
                offset: f64::INFINITY,
            }),
        }
    }

    /// How far a point is from the eye as the projection divides by it, linear in the point's place: the direction in which it grows, of any length, and its value at
    /// the eye. The distance along the view direction in perspective, 1 everywhere in a parallel view.
    #[must_use]
    pub fn divisor(&self) -> (DVec3, f64) {
        match self.projection {
            Projection::Perspective { .. } | Projection::OffAxis { .. } => (self.forward(), 0.0),
            Projection::Orthographic { .. } => (DVec3::ZERO, 1.0),
            Projection::Matrix(matrix) => turned(matrix.rows()[3], self.rotation),
        }
    }

    /// The rotation from camera-relative world coordinates to view coordinates. It is the view matrix without its
    /// translation, which is subtracted in f64 before anything goes to the GPU.
    #[must_use]
    pub fn view_rotation(&self) -> Mat4 {
        Mat4::from_quat(self.rotation.conjugate().as_quat())
    }

    /// The matrix from world coordinates relative to the camera to clip coordinates. `aspect` is width divided by height.
    #[must_use]
    pub fn clip_from_relative(&self, aspect: f64) -> Mat4 {
        match self.projection {
            // A host's matrix may have numbers that differ by more than f32 tells apart before they are turned.
            Projection::Matrix(matrix) => {
                (matrix.matrix() * DMat4::from_quat(self.rotation.conjugate())).as_mat4()
            }
            _ => self.projection_matrix(aspect) * self.view_rotation(),
        }
    }

    /// The projection from view to clip coordinates. Depth is 1 at the near plane and 0 at infinity (perspective) or
    /// at the far plane (orthographic). `aspect` is width divided by height.
    #[must_use]
    pub fn projection_matrix(&self, aspect: f64) -> Mat4 {
        self.projection.matrix(aspect)
    }

    /// The view frustum at this aspect (width divided by height). It is widened by a millionth, so that no rounding
    /// on the GPU adds a pixel from outside.
    #[must_use]
    pub fn frustum(&self, aspect: f64) -> Frustum {
        self.window(aspect, DVec2::NEG_ONE, DVec2::ONE)
    }

    /// The view frustum of a part of the image, widened by the same millionth. The part spans from `low` to `high` in
    /// normalised device coordinates: -1 to 1, rightwards and upwards.
    #[must_use]
    pub fn window(&self, aspect: f64, low: DVec2, high: DVec2) -> Frustum {
        if let Projection::Matrix(matrix) = self.projection {
            return Frustum::new(self.matrix_window(&matrix, low, high));
        }
        let mut planes = self.sides(aspect, low, high);
        let forward = self.forward();
        let near = self.near();
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

    /// Whether the near plane may cut the visible part of the box, or the eye may be inside the box.
    ///
    /// The test is conservative: the box is first widened a little, and a box close to the near rectangle may count
    /// as crossing. Such a box must count as visible, since its clipped outline covers too few pixels.
    #[must_use]
    pub fn crosses_near(&self, bounds: &Aabb, aspect: f64) -> bool {
        if bounds.is_empty() {
            return false;
        }
        if let Projection::Matrix(matrix) = self.projection {
            return self.matrix_crosses_near(&matrix, bounds);
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
        let mut planes = self.sides(aspect, DVec2::NEG_ONE, DVec2::ONE);
        let near_point = self.position + forward * near;
        planes.push(Plane::through(near_point, -forward));
        if parallel {
            // The volume in front of the near plane is unbounded. The near plane cuts only boxes on both sides of it.
            planes.push(Plane::through(near_point, forward));
        }
        let (centre, radius) = self.near_ball(aspect);
        bounds.distance(centre) <= radius && Frustum::new(planes).intersects(&bounds)
    }

    /// The distance in metres from the eye to the nearest of the box's eight corners.
    #[must_use]
    pub fn nearest_corner_distance(&self, bounds: &Aabb) -> f64 {
        let squared = bounds.corners().map(|c| c.distance_squared(self.position));
        squared.into_iter().fold(f64::INFINITY, f64::min).sqrt()
    }

    /// The side planes of a part of the image, with inward normals.
    fn sides(&self, aspect: f64, low: DVec2, high: DVec2) -> Vec<Plane> {
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
                vec![
                    Plane::through(self.position + right * (x * low.x), right),
                    Plane::through(self.position + right * (x * high.x), -right),
                    Plane::through(self.position + up * (y * low.y), up),
                    Plane::through(self.position + up * (y * high.y), -up),
                ]
            }
            Projection::Matrix(matrix) => self.matrix_sides(&matrix, low, high),
        }
    }

    /// The side planes of a part of a window whose centre is off the axis by these tangents.
    fn pyramid(
        &self,
        fov_y: f64,
        shift: DVec2,
        aspect: f64,
        (low, high): (DVec2, DVec2),
    ) -> Vec<Plane> {
        let (right, up, forward) = (self.right(), self.up(), self.forward());
        let slack = self.rounding();
        let y = (fov_y * 0.5).tan() * (1.0 + OPENING);
        // The error of a number on the GPU is relative, so a window far off the axis is widened by more.
        let half = DVec2::new(y * aspect, y) + shift.abs() * OPENING;
        let (low, high) = (-half * low - shift, half * high + shift);
        let side = |normal: DVec3| {
            let normal = normal.normalize();
            Plane::through(self.position - normal * slack, normal)
        };
        vec![
            side(right + forward * low.x),
            side(forward * high.x - right),
            side(up + forward * low.y),
            side(forward * high.y - up),
        ]
    }

    /// A ball around the visible volume in front of the near plane: around the eye in perspective, up to the window's
    /// farthest corner; around the near rectangle otherwise.
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
            Projection::Matrix(_) => (self.position, f64::INFINITY),
        }
    }

    /// The f64 rounding error, in metres, of planes through the camera's position.
    fn rounding(&self) -> f64 {
        self.position.abs().max_element() * (16.0 * f64::EPSILON)
    }
}
