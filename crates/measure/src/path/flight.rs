//! Flights: a smooth spline around and through a scene, by seeded points, one outside, two inside, and so on.
//!
//! The curve is a uniform cubic B-spline (William J. Gordon and Richard F. Riesenfeld, "B-Spline Curves and Surfaces", 1974), sampled evenly in
//! its parameter: speed and direction are continuous, and tight curves are slow. The viewing direction is a spline of yaw and pitch. It has no
//! roll, and does not flip where a target passes the eye.

use antumbra_scene::{Aabb, Projection};
use glam::{DQuat, DVec3, EulerRot};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::orbit::{Sphere, bounding_sphere};
use super::{CameraPath, Pose};
use crate::MeasureError;

/// Points of the spline: from outside through the inside and out again, three times.
const POINTS: usize = 10;
/// The steepest pitch in radians. A steeper camera sees mostly floor or sky.
const STEEPEST: f64 = 0.9;

/// A control point of the spline.
#[derive(Debug, Clone, Copy)]
struct Key {
    position: DVec3,
    yaw: f64,
    pitch: f64,
}

/// A point of a flight, in world metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waypoint {
    /// The eye.
    pub eye: DVec3,
    /// The point that it looks at.
    pub target: DVec3,
}

impl CameraPath {
    /// A smooth flight around and through a scene. The same seed gives the same path. Empty bounds, as of a scene without entities, are taken
    /// as a point.
    ///
    /// # Errors
    /// [`MeasureError::Path`] for no frames or more than [`MAX_POSES`](super::MAX_POSES), and for bounds that are not finite.
    pub fn flight(bounds: &Aabb, seed: u64, frames: usize) -> Result<Self, MeasureError> {
        let Sphere { centre, radius } = bounding_sphere("flight", bounds)?;
        let half = if bounds.is_empty() {
            DVec3::ZERO
        } else {
            bounds.half_extents()
        };
        let keys = keys(centre, half, radius, seed);
        let projection = Projection::Perspective {
            fov_y: 60f64.to_radians(),
            near: radius * 1e-4,
        };
        Self::new("flight", projection, along(&keys, frames))
    }

    /// A smooth flight by waypoints. The camera starts at the first and ends at the last; it passes near the others. The whole flight has
    /// `whole` frames. The path takes `frames` of them, in bursts of [`BURST`] consecutive frames that are spread evenly over the flight. Each
    /// burst begins with a cut. So a short path covers the whole flight, and consecutive frames still differ as little as on a screen.
    ///
    /// # Errors
    /// [`MeasureError::Path`] for no waypoints, and as for [`CameraPath::new`].
    pub fn through(
        name: impl Into<String>,
        waypoints: &[Waypoint],
        projection: Projection,
        whole: usize,
        frames: usize,
    ) -> Result<Self, MeasureError> {
        let mut last_yaw = None;
        let keys: Vec<Key> = waypoints
            .iter()
            .map(|Waypoint { eye, target }| Key::towards(*eye, *target - *eye, &mut last_yaw))
            .collect();
        let frames = if keys.is_empty() { 0 } else { frames };
        if frames >= whole {
            return Self::new(name, projection, along(&keys, frames));
        }
        let bursts = frames.div_ceil(BURST);
        let step = keys.len().saturating_sub(1) as f64 / whole.saturating_sub(1).max(1) as f64;
        let first = |burst: usize| match bursts {
            1 => 0,
            _ => burst * (whole - BURST.min(frames)) / (bursts - 1),
        };
        let poses = (0..frames).map(|frame| {
            let (burst, within) = (frame / BURST, frame % BURST);
            Pose {
                cut: within == 0,
                ..pose(&keys, (first(burst) + within) as f64 * step)
            }
        });
        Self::new(name, projection, poses.collect())
    }
}

/// Frames of a burst: consecutive frames of a flight that is not measured as a whole.
pub const BURST: usize = 12;

/// Poses spread evenly over the spline's parameter.
fn along(keys: &[Key], frames: usize) -> Vec<Pose> {
    let frames = frames.min(super::MAX_POSES + 1);
    let stretches = keys.len().saturating_sub(1) as f64;
    let step = stretches / frames.saturating_sub(1).max(1) as f64;
    (0..frames)
        .map(|frame| pose(keys, frame as f64 * step))
        .collect()
}

impl Key {
    /// A control point that looks along `way`. `last_yaw` is the yaw of the one before, and is set to this one's.
    fn towards(position: DVec3, way: DVec3, last_yaw: &mut Option<f64>) -> Self {
        let pitch = way.y.atan2(way.x.hypot(way.z)).clamp(-STEEPEST, STEEPEST);
        let yaw = (-way.x).atan2(-way.z);
        // The equivalent angle that is nearest to the one before.
        let yaw = last_yaw.map_or(yaw, |before| before + wrapped(yaw - before));
        *last_yaw = Some(yaw);
        Self {
            position,
            yaw,
            pitch,
        }
    }
}

/// Control points: one outside, two inside, and so on. Outside, the camera looks at a point inside; inside, along its way.
fn keys(centre: DVec3, half: DVec3, radius: f64, seed: u64) -> Vec<Key> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let start = random.random_range(0.0..std::f64::consts::TAU);
    let mut within = |reach: f64| {
        let unit = DVec3::from_array(std::array::from_fn(|_| random.random_range(-reach..=reach)));
        centre + unit * half
    };
    let inside: Vec<DVec3> = (0..POINTS).map(|_| within(0.7)).collect();
    let places: Vec<DVec3> = inside
        .iter()
        .enumerate()
        .map(|(i, &place)| {
            if i % 3 != 0 {
                return place;
            }
            let angle = start + i as f64 * (0.9 + 0.5 * random.random::<f64>());
            let (sin, cos) = angle.sin_cos();
            centre
                + DVec3::new(sin, random.random_range(0.1..0.5), cos)
                    * radius
                    * random.random_range(1.1..1.6)
        })
        .collect();
    let mut last_yaw: Option<f64> = None;
    places
        .iter()
        .enumerate()
        .map(|(i, &position)| {
            let outside = i % 3 == 0;
            let target = if outside {
                inside.get(i)
            } else {
                places.get(i + 1)
            };
            let way = target.map_or(DVec3::ZERO, |target| *target - position);
            Key::towards(position, way, &mut last_yaw)
        })
        .collect()
}

/// The equivalent angle in -pi to pi.
fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    (angle + PI).rem_euclid(TAU) - PI
}

fn pose(keys: &[Key], t: f64) -> Pose {
    let key = at(keys, t);
    let rotation = DQuat::from_euler(EulerRot::YXZ, key.yaw, key.pitch, 0.0);
    Pose {
        position: key.position,
        rotation: rotation.normalize(),
        cut: false,
    }
}

/// The spline at `t`. Control point *i* is at *t* = *i*; the end points are repeated.
fn at(keys: &[Key], t: f64) -> Key {
    let last = keys.len() - 1;
    let i = (t.max(0.0) as usize).min(last.saturating_sub(1));
    let near = [i.saturating_sub(1), i, (i + 1).min(last), (i + 2).min(last)].map(|k| keys[k]);
    let weights = b_spline(t - i as f64);
    let sum = |of: fn(&Key) -> f64| {
        near.iter()
            .zip(weights)
            .map(|(key, w)| of(key) * w)
            .sum::<f64>()
    };
    // Relative to a control point, so that positions far from the origin keep their precision.
    let origin = near[1].position;
    let position = near
        .iter()
        .zip(weights)
        .map(|(key, w)| (key.position - origin) * w)
        .sum::<DVec3>()
        + origin;
    Key {
        position,
        yaw: sum(|key| key.yaw),
        pitch: sum(|key| key.pitch),
    }
}

/// The weights of the four control points around a segment, at `t` from 0 to 1 in it.
fn b_spline(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        (1.0 - 3.0 * t + 3.0 * t2 - t3) / 6.0,
        (4.0 - 6.0 * t2 + 3.0 * t3) / 6.0,
        (1.0 + 3.0 * t + 3.0 * t2 - 3.0 * t3) / 6.0,
        t3 / 6.0,
    ]
}
