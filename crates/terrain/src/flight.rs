//! Flights over a terrain, low above its ground.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::show::to_world;
use crate::terrain::Terrain;

impl Terrain {
    /// Stations of a flight over the terrain, `height` metres above what lies within a hundred metres, and the place that is looked at
    /// from each: a figure of eight around the middle, in the world.
    #[must_use]
    pub fn flight(&self, height: f64, stations: usize) -> Vec<[DVec3; 2]> {
        let [low, high] = self.field().plan_bounds();
        let (middle, size) = ((low + high) / 2.0, (high - low) * 0.32);
        let plan = |turn: f64| {
            let angle = turn * TAU;
            middle + DVec2::new(angle.sin(), (2.0 * angle).sin() * 0.6) * size
        };
        let above = |place: DVec2| {
            let highest = self.highest_near(place, 100.0).unwrap_or_default();
            place.extend(highest + height)
        };
        (0..stations)
            .map(|station| {
                let turn = station as f64 / stations as f64;
                let [here, ahead] = [turn, turn + 0.02].map(|turn| above(plan(turn)));
                let level = DVec3::new(ahead.x, ahead.y, ahead.z.min(here.z) - height * 0.5);
                [here, level].map(|place| to_world(place + self.field().origin()))
            })
            .collect()
    }
}
