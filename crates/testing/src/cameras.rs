//! Cameras with Y up.

use antumbra_scene::{Camera, Projection};
use glam::DVec3;

/// A perspective projection; the vertical field of view in radians, the near plane in metres.
pub fn perspective(fov_y: f64, near: f64) -> Projection {
    Projection::Perspective { fov_y, near }
}

/// A perspective projection; the vertical field of view in degrees, the near plane in metres.
pub fn perspective_degrees(fov_y: f64, near: f64) -> Projection {
    perspective(fov_y.to_radians(), near)
}

/// A camera at `eye` that looks at `target`.
pub fn look_at(eye: DVec3, target: DVec3, projection: Projection) -> Camera {
    Camera::look_at(eye, target, DVec3::Y, projection).unwrap()
}

/// A camera over pixels a metre wide that looks down -Z: what lies at (x, y) is `x` pixels right of the image's middle and `y` above it.
pub fn over_pixels(eye: DVec3, size: [u32; 2]) -> Camera {
    let projection = Projection::Orthographic {
        height: f64::from(size[1]),
        near: 0.0,
        far: 100.0,
    };
    look_at(eye, eye - DVec3::Z, projection)
}
