//! The extent of the model in metres, and its world coordinates.

use glam::{DVec2, DVec3};

/// Half the extent of the field in metres, east and north.
pub(super) const HALF: DVec2 = DVec2::new(3275.0, 2962.5);
/// Depth of the volume in metres.
pub(super) const DEPTH: f64 = 3000.0;

/// World coordinates of a place (metres east and north of the centre) at a depth in metres.
pub(super) fn world(place: DVec2, depth: f64) -> DVec3 {
    DVec3::new(place.x, -depth, -place.y)
}
