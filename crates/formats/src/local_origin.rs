//! An origin near a geometry. Positions far from the origin, such as those of maps, lose centimetres or metres in f32. They are read as f64,
//! and what is stored is their distance from an origin of their own, which becomes the entity's translation.

use antumbra_scene::Geometry;
use glam::{DAffine3, DVec3};

/// Positions relative to an origin, both in metres.
pub(crate) struct LocalPositions {
    /// The origin.
    pub(crate) origin: DVec3,
    /// One for each position.
    pub(crate) positions: Vec<[f32; 3]>,
}

/// A geometry and the transform to the file's coordinates.
pub(crate) struct Placed {
    pub(crate) geometry: Geometry,
    pub(crate) transform: DAffine3,
}

/// A box that reaches this many times its size away from the file's origin gets an origin of its own: two of the 24 bits of an f32.
const FAR: f64 = 4.0;

impl LocalPositions {
    /// The transform from the positions to the file's coordinates.
    pub(crate) fn transform(&self) -> DAffine3 {
        DAffine3::from_translation(self.origin)
    }
}

/// Moves positions to an origin of their own where they are far from that of the file. Positions that are not finite stay so.
pub(crate) fn localise(positions: impl Iterator<Item = DVec3> + Clone) -> LocalPositions {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for position in positions.clone().filter(|position| position.is_finite()) {
        (low, high) = (low.min(position), high.max(position));
    }
    let size = (high - low).max_element();
    let reach = low.abs().max(high.abs()).max_element();
    // A whole number, so that coordinates with few digits stay exact.
    let middle = low.midpoint(high).round();
    let origin = if reach.is_finite() && reach > FAR * size {
        middle
    } else {
        DVec3::ZERO
    };
    LocalPositions {
        origin,
        positions: positions
            .map(|position| (position - origin).as_vec3().to_array())
            .collect(),
    }
}
