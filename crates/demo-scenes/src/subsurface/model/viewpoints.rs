//! Lights, viewpoints and a flight for the model.

use super::Model;
use super::extent::{DEPTH, HALF, world};
use antumbra_scene::Light;
use glam::{DVec2, DVec3};

/// A named camera position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewpoint {
    /// Its name.
    pub name: &'static str,
    /// Position of the camera, in world metres.
    pub position: DVec3,
    /// The point that the camera looks at, in world metres; +Y is up.
    pub target: DVec3,
    /// Vertical field of view in radians.
    pub fov_y: f64,
}

/// A light of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelLight {
    /// Its position, in world metres.
    pub position: DVec3,
    /// The light.
    pub light: Light,
}

/// A control point of the flight through the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlightPoint {
    /// The position of the camera, in world metres.
    pub eye: DVec3,
    /// The point that the camera looks at, in world metres; +Y is up.
    pub target: DVec3,
}

impl Model {
    /// Two point lights above the field; their intensities fit its size.
    #[must_use]
    pub fn lights(&self) -> [ModelLight; 2] {
        // In candela: about three lux at the centre of the model from the first light, one lux from the second.
        [
            (DVec3::new(3000.0, 2700.0, 2500.0), [1.0, 0.97, 0.92], 1.0e8),
            (
                DVec3::new(-3800.0, 2300.0, -3600.0),
                [0.85, 0.92, 1.0],
                5.0e7,
            ),
        ]
        .map(|(position, colour, intensity)| {
            let range = None;
            let light = Light::Point {
                colour,
                intensity,
                range,
            };
            ModelLight { position, light }
        })
    }

    /// Two viewpoints: `open` is above the cut-outs and sees many layers; from `occluded` the upper horizons and the
    /// slices hide most of the model.
    #[must_use]
    pub fn views(&self) -> [Viewpoint; 2] {
        let fov_y = 40f64.to_radians();
        [
            Viewpoint {
                name: "open",
                position: DVec3::new(6900.0, 3500.0, 6500.0),
                target: DVec3::new(350.0, -1700.0, 350.0),
                fov_y,
            },
            Viewpoint {
                name: "occluded",
                position: DVec3::new(-2700.0, 6200.0, -2400.0),
                target: DVec3::new(150.0, -1100.0, 150.0),
                fov_y,
            },
        ]
    }

    /// The control points of a closed flight around and into the model.
    #[must_use]
    pub fn flight(&self) -> Vec<FlightPoint> {
        let middle = self.options.horizons as usize / 2;
        let centre = DVec3::new(0.0, -1400.0, 0.0);
        // The middle of the widest gap near a horizon, at a place relative to half the field's extent.
        let between = |horizon: usize, x: f64, y: f64| {
            let place = HALF * DVec2::new(x, y);
            let about = horizon.saturating_sub(1)..horizon + 3;
            let depths: Vec<f64> = about.filter_map(|k| self.depth(k, place)).collect();
            let spaces = depths.array_windows::<2>().copied();
            let widest = spaces.max_by(|[a, b], [c, d]| (b - a).total_cmp(&(d - c)));
            let [above, below] = widest.unwrap_or([0.0, DEPTH]);
            world(place, f64::midpoint(above, below))
        };
        let (upper, lower) = (middle, middle + 2);
        [
            (DVec3::new(6400.0, 3000.0, 5600.0), centre),
            (DVec3::new(600.0, 2600.0, 7000.0), centre),
            (DVec3::new(-5200.0, 2300.0, 4400.0), centre),
            (DVec3::new(-5400.0, 1600.0, -2600.0), centre),
            (DVec3::new(-600.0, 1700.0, -4600.0), centre),
            (DVec3::new(3600.0, 900.0, -1800.0), centre),
            // Down into the cut-out and along the layers.
            (
                DVec3::new(4300.0, -300.0, 2600.0),
                between(upper, 0.3, -0.3),
            ),
            (between(upper, 0.55, -0.5), between(upper, -0.2, 0.0)),
            (between(upper, 0.1, -0.1), between(upper, -0.6, 0.3)),
            (between(lower, -0.45, 0.2), between(lower, -0.9, -0.5)),
            // Out of the model in the south-west and back.
            (between(lower, -0.8, -0.6), between(lower, -0.6, -1.4)),
            (DVec3::new(-2400.0, -900.0, 4600.0), centre),
            (DVec3::new(2800.0, 800.0, 6800.0), centre),
        ]
        .map(|(eye, target)| FlightPoint { eye, target })
        .to_vec()
    }
}
