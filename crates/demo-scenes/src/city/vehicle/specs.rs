//! The data that describe a vehicle.

use crate::city::city_builder::Prefab;

/// Position of the wheels: x of front and rear axle, distance of the wheels from the centre line, and height of the
/// hubs.
pub(super) struct Stance {
    pub axles: [f64; 2],
    pub track: f64,
    pub radius: f64,
}

/// The differences between a saloon and a van.
pub(super) struct Car {
    pub body: Prefab,
    pub trim: &'static [Prefab],
    pub stance: Stance,
    /// Positions of the seats: forwards, upwards, and to each side.
    pub seats: &'static [[f64; 3]],
    pub dashboard: [f64; 3],
    pub engine: [f64; 3],
}
