//! A camera path low above a terrain.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::field::Field;
use crate::terrain::Terrain;
use crate::world::to_world;

/// A station of a flight. Positions are in the world: X east, Y up, Z south, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlightStation {
    /// The position of the camera.
    pub eye: DVec3,
    /// The position that the camera looks at.
    pub target: DVec3,
}

impl Terrain {
    /// The stations of a flight over the terrain: a figure of eight around its middle, `height` metres above the highest surface within a
    /// hundred metres.
    #[must_use]
    pub fn flight(&self, height: f64, stations: usize) -> Vec<FlightStation> {
        let highest = |at: DVec2, reach| self.highest_near(at, reach);
        flight(self.field(), &highest, height, stations)
    }
}

/// A flight over a field. `highest` is an upper bound of the surface's height within a distance of a position.
pub(crate) fn flight(
    field: &Field,
    highest: &dyn Fn(DVec2, f64) -> Option<f64>,
    height: f64,
    stations: usize,
) -> Vec<FlightStation> {
    let [low, high] = field.plan_bounds();
    let (middle, size) = ((low + high) / 2.0, (high - low) * 0.32);
    let plan = |turn: f64| {
        let angle = turn * TAU;
        middle + DVec2::new(angle.sin(), (2.0 * angle).sin() * 0.6) * size
    };
    let above = |at: DVec2| {
        let highest = highest(at, 100.0).unwrap_or_default();
        at.extend(highest + height)
    };
    (0..stations)
        .map(|station| {
            let turn = station as f64 / stations as f64;
            let [here, ahead] = [turn, turn + 0.02].map(|turn| above(plan(turn)));
            let target = DVec3::new(ahead.x, ahead.y, ahead.z.min(here.z) - height * 0.5);
            let [eye, target] = [here, target].map(|at| to_world(at + field.origin()));
            FlightStation { eye, target }
        })
        .collect()
}
