//! Orbits: a camera that circles a centre at one height and looks at it.

use antumbra_scene::{Aabb, Projection};
use glam::DVec3;

use super::{CameraPath, Pose};
use crate::MeasureError;

/// The elevation of [`CameraPath::orbit_around`]. At 20 degrees the camera sees past the first row of objects and still sees their sides.
const ELEVATION: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// A circle around a centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// What the camera looks at, world metres.
    pub centre: DVec3,
    /// The circle's radius in metres.
    pub distance: f64,
    /// The circle's height above the centre in metres.
    pub height: f64,
    /// The vertical field of view in radians.
    pub fov_y: f64,
    /// The near plane's distance in metres.
    pub near: f64,
    /// The angle between two frames in radians, counter-clockwise seen from above.
    pub radians_per_frame: f64,
    /// The number of poses.
    pub frames: usize,
}

impl Orbit {
    /// The orbit of the built-in grid: 40 m from the centre, 10 m above it, 45 degrees, 0.02 radians a frame.
    pub fn grid(frames: usize) -> Self {
        Self {
            centre: DVec3::ZERO,
            distance: 40.0,
            height: 10.0,
            fov_y: 45f64.to_radians(),
            near: 0.1,
            radians_per_frame: 0.02,
            frames,
        }
    }
}

impl CameraPath {
    /// An orbit that starts on the +Z side of the centre.
    ///
    /// # Errors
    /// [`MeasureError::Path`] for no frames or more than [`MAX_POSES`](super::MAX_POSES), a number that is not finite, an eye at the centre, or
    /// a projection that is not valid.
    pub fn orbit(orbit: &Orbit) -> Result<Self, MeasureError> {
        let fail = |problem| MeasureError::Path {
            name: "orbit".to_owned(),
            problem,
        };
        let frames = orbit.frames.min(super::MAX_POSES + 1);
        let poses = (0..frames).map(|frame| {
            let (sin, cos) = (frame as f64 * orbit.radians_per_frame).sin_cos();
            let away = DVec3::new(orbit.distance * sin, orbit.height, orbit.distance * cos);
            Pose::look_at(orbit.centre + away, orbit.centre, None)
                .map_err(|e| fail(format!("pose {frame}: {e}")))
        });
        let projection = Projection::Perspective {
            fov_y: orbit.fov_y,
            near: orbit.near,
        };
        Self::new("orbit", projection, poses.collect::<Result<_, _>>()?)
    }

    /// One revolution around a scene, with the whole scene in view. `aspect` is the image's width over its height; the vertical field of view
    /// is 45 degrees. Empty bounds, as of a scene without entities, are taken as a point.
    ///
    /// # Errors
    /// As for [`CameraPath::orbit`]; also for bounds that are not finite, and for an aspect that is not above 0.
    pub fn orbit_around(bounds: &Aabb, aspect: f64, frames: usize) -> Result<Self, MeasureError> {
        let Sphere { centre, radius } = bounding_sphere("orbit", bounds)?;
        if !(aspect > 0.0 && aspect.is_finite()) {
            let problem = format!("an aspect of {aspect} is not above 0");
            return Err(MeasureError::Path {
                name: "orbit".to_owned(),
                problem,
            });
        }
        let fov_y = 45f64.to_radians();
        let half = (fov_y / 2.0).min(((fov_y / 2.0).tan() * aspect).atan());
        // 5 % more, so that the sphere does not touch the image's edge.
        let away = 1.05 * radius / half.sin();
        Self::orbit(&Orbit {
            centre,
            distance: away * ELEVATION.cos(),
            height: away * ELEVATION.sin(),
            fov_y,
            near: (away - radius) * 0.1,
            radians_per_frame: std::f64::consts::TAU / frames.max(1) as f64,
            frames,
        })
    }
}

/// A sphere.
pub(super) struct Sphere {
    pub centre: DVec3,
    /// Metres.
    pub radius: f64,
}

/// The sphere through a box's corners. For a point or empty bounds its radius is 1 m, so that a path around it has an extent.
pub(super) fn bounding_sphere(name: &str, bounds: &Aabb) -> Result<Sphere, MeasureError> {
    if bounds.is_empty() {
        return Ok(Sphere {
            centre: DVec3::ZERO,
            radius: 1.0,
        });
    }
    if !bounds.is_finite() {
        let problem = format!("the bounds {} to {} are not finite", bounds.min, bounds.max);
        return Err(MeasureError::Path {
            name: name.to_owned(),
            problem,
        });
    }
    let radius = bounds.half_extents().length();
    Ok(Sphere {
        centre: bounds.centre(),
        radius: if radius > 0.0 { radius } else { 1.0 },
    })
}
