//! Conversion between terrain coordinates (metres east, north and up) and world coordinates (Y up, Z south).

use glam::DVec3;

/// Converts a position from metres east, north and up to the world's axes: X east, Y up, Z south.
#[must_use]
pub fn to_world(position: DVec3) -> DVec3 {
    DVec3::new(position.x, position.z, -position.y)
}

/// The inverse of [`to_world`].
pub(crate) fn from_world(position: DVec3) -> DVec3 {
    DVec3::new(position.x, -position.z, position.y)
}
