//! A flight through and around a scene: a smooth spline by seeded points, one outside, two inside,
//! and so on.
//!
//! The curve is a uniform cubic B-spline (William J. Gordon and Richard F. Riesenfeld, "B-Spline
//! Curves and Surfaces", 1974) flown in its own time: speed and direction never jump, and tight
//! turns are flown slowly. Where the camera looks is a spline of its own, of yaw and pitch: without
//! roll, and without the flips of a target that passes the eye.

use antumbra_scene::{Aabb, Projection};
use glam::{DQuat, DVec3, EulerRot};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::orbit::bounding_sphere;
use super::{CameraPath, Pose};
use crate::MeasureError;

/// Points of the spline: from outside through the inside and out again, three times.
const POINTS: usize = 10;
/// Looking steeper than this shows mostly floor or sky.
const STEEPEST: f64 = 0.9;

/// A place of the spline: where the camera is and where it looks.
#[derive(Debug, Clone, Copy)]
struct Key {
    position: DVec3,
    yaw: f64,
    pitch: f64,
}

impl CameraPath {
    /// A smooth flight around and through a scene. The same seed flies the same path. Empty bounds,
    /// those of a scene without entities, are a point.
    ///
    /// # Errors
    /// No frames or more than [`MAX_POSES`](super::MAX_POSES); bounds that are not finite.
    pub fn flight(bounds: &Aabb, seed: u64, frames: usize) -> Result<Self, MeasureError> {
        let (centre, radius) = bounding_sphere("flight", bounds)?;
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

    /// A smooth flight of your own: by places, each an eye and what it looks at, in world metres. The camera starts at the first and ends
    /// at the last; between, it passes near them. The whole flight takes `whole` frames; of them `frames` are taken, in bursts of
    /// [`BURST`] consecutive ones evenly spread over it, each beginning with a cut: so that a few frames show all of the flight, and
    /// each still follows closely on the one before, as it would on a screen.
    ///
    /// # Errors
    /// No places; as for [`CameraPath::new`].
    pub fn through(
        name: impl Into<String>,
        places: &[(DVec3, DVec3)],
        projection: Projection,
        whole: usize,
        frames: usize,
    ) -> Result<Self, MeasureError> {
        let mut turned = None;
        let keys: Vec<Key> = places
            .iter()
            .map(|(eye, target)| Key::towards(*eye, *target - *eye, &mut turned))
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

/// Consecutive frames of a flight that is not measured whole.
pub const BURST: usize = 12;

/// Poses evenly spread over the spline's time.
fn along(keys: &[Key], frames: usize) -> Vec<Pose> {
    let frames = frames.min(super::MAX_POSES + 1);
    let stretches = keys.len().saturating_sub(1) as f64;
    let step = stretches / frames.saturating_sub(1).max(1) as f64;
    (0..frames)
        .map(|frame| pose(keys, frame as f64 * step))
        .collect()
}

impl Key {
    /// Looking along `way`; `turned` is the yaw of the key before, and becomes this one's.
    fn towards(position: DVec3, way: DVec3, turned: &mut Option<f64>) -> Self {
        let pitch = way.y.atan2(way.x.hypot(way.z)).clamp(-STEEPEST, STEEPEST);
        let yaw = (-way.x).atan2(-way.z);
        // The shorter way round from the key before.
        let yaw = turned.map_or(yaw, |before| before + wrapped(yaw - before));
        *turned = Some(yaw);
        Self {
            position,
            yaw,
            pitch,
        }
    }
}

/// One outside, two inside, and so on. Outside, the camera looks at a point inside; inside, along
/// its way.
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
    let mut turned: Option<f64> = None;
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
            Key::towards(position, way, &mut turned)
        })
        .collect()
}

/// An angle brought into -pi to pi.
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

/// The spline at `t`, whose whole numbers are the keys; the ends are repeated.
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
    // Relative to the first key: positions far from the origin keep their small differences.
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

/// The weights of the four keys around a stretch, `t` from 0 to 1 along it.
fn b_spline(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        (1.0 - 3.0 * t + 3.0 * t2 - t3) / 6.0,
        (4.0 - 6.0 * t2 + 3.0 * t3) / 6.0,
        (1.0 + 3.0 * t + 3.0 * t2 - 3.0 * t3) / 6.0,
        t3 / 6.0,
    ]
}
