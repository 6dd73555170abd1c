//! What deforms a primitive, kept for its animations.

use antumbra_scene::Geometry;
use antumbra_scene::animation::{Influences, MorphTarget};

/// A primitive before morph targets and skin, and what these do.
pub(super) struct Deformation {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) targets: Vec<MorphTarget>,
    pub(super) influences: Influences,
}

impl Deformation {
    /// Bytes a vertex: kept twice, here and as a pose is made of it.
    pub(super) const VERTEX: u64 = 48;

    /// That of a geometry which has neither targets nor skin yet.
    pub(super) fn of(geometry: &Geometry) -> Self {
        Self {
            positions: geometry.positions.clone(),
            normals: geometry.normals.clone(),
            targets: Vec::new(),
            influences: Influences::default(),
        }
    }
}
