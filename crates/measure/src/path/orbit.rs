//! Around a centre at one height, looking at it: the steady camera of the papers.

use antumbra_scene::{Aabb, Projection};
use glam::DVec3;

use super::{CameraPath, Pose};
use crate::MeasureError;

/// How steeply [`CameraPath::orbit_around`] looks down: 20 degrees see past the first row of things
/// without becoming a map.
const ELEVATION: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// A circle around a centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// What the camera looks at, world metres.
    pub centre: DVec3,
    /// The circle's radius in metres.
    pub distance: f64,
    /// How far above the centre the circle lies, metres.
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
    /// The orbit of the built-in grid: 40 m from the centre, 10 m up, 45 degrees, 0.02 radians a
    /// frame.
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
    /// A circle around a centre, starting on the +Z side of it.
    ///
    /// # Errors
    /// No frames or more than [`MAX_POSES`](super::MAX_POSES), a number that is not finite, the eye
    /// on the centre, or a projection that cannot be drawn.
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

    /// One turn around any scene with the whole of it in view. `aspect` is width over height of the
    /// picture, 45 degrees are the vertical field of view. Empty bounds, those of a scene without
    /// entities, are a point.
    ///
    /// # Errors
    /// As [`CameraPath::orbit`]; bounds that are not finite; an aspect that is not above 0.
    pub fn orbit_around(bounds: &Aabb, aspect: f64, frames: usize) -> Result<Self, MeasureError> {
        let (centre, radius) = bounding_sphere("orbit", bounds)?;
        if !(aspect > 0.0 && aspect.is_finite()) {
            let problem = format!("an aspect of {aspect} is not above 0");
            return Err(MeasureError::Path {
                name: "orbit".to_owned(),
                problem,
            });
        }
        let fov_y = 45f64.to_radians();
        let half = (fov_y / 2.0).min(((fov_y / 2.0).tan() * aspect).atan());
        // A twentieth more, so that the sphere does not touch the picture's edge.
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

/// The sphere through a box's corners; that of a point, or of nothing, has a radius of 1 m, so that
/// there is something to stand off from.
pub(super) fn bounding_sphere(name: &str, bounds: &Aabb) -> Result<(DVec3, f64), MeasureError> {
    if bounds.is_empty() {
        return Ok((DVec3::ZERO, 1.0));
    }
    if !bounds.is_finite() {
        let problem = format!("the bounds {} to {} are not finite", bounds.min, bounds.max);
        return Err(MeasureError::Path {
            name: name.to_owned(),
            problem,
        });
    }
    let radius = bounds.half_extents().length();
    Ok((bounds.centre(), if radius > 0.0 { radius } else { 1.0 }))
}
