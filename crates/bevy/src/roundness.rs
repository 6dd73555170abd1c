//! How round meshes are: what lies in the ellipsoid within its box is found hidden more often than what may fill it.

use antumbra::glam::DVec3;
use antumbra::scene::Aabb as Bounds;
use bevy::asset::AssetId;
use bevy::camera::primitives::Aabb;
use bevy::mesh::VertexAttributeValues;
use bevy::platform::collections::HashMap;
use bevy::prelude::*;

use crate::occludees::bounds_of;

/// The roundness of meshes, by asset.
#[derive(Default)]
pub(crate) struct Roundness {
    known: HashMap<AssetId<Mesh>, Known>,
}

/// A mesh in its box.
#[derive(Clone, Copy)]
struct Known {
    aabb: Aabb,
    roundness: f32,
}

impl Roundness {
    /// That of a mesh that may fill its box.
    pub const ANGULAR: f32 = 2.0;

    /// That of a mesh in a box, which counts only where it is the mesh's own.
    pub fn of(&mut self, id: AssetId<Mesh>, meshes: &Assets<Mesh>, aabb: &Aabb) -> f32 {
        let known = self.known.get(&id).copied().or_else(|| {
            let known = Known::of(meshes.get(id)?)?;
            self.known.insert(id, known);
            Some(known)
        });
        let own = known.filter(|known| known.aabb == *aabb);
        own.map_or(Self::ANGULAR, |known| known.roundness)
    }

    /// Forgets a mesh that is another one now.
    pub fn forget(&mut self, id: AssetId<Mesh>) {
        self.known.remove(&id);
    }
}

impl Known {
    /// `None` for a mesh without positions in memory, and for one that morph targets move within its box.
    fn of(mesh: &Mesh) -> Option<Self> {
        if mesh.try_has_morph_targets().unwrap_or(true) {
            return None;
        }
        let Ok(VertexAttributeValues::Float32x3(positions)) =
            mesh.try_attribute(Mesh::ATTRIBUTE_POSITION)
        else {
            return None;
        };
        let aabb = Aabb::enclosing(positions.iter().copied().map(Vec3::from_array))?;
        let bounds: Bounds = bounds_of(&aabb);
        let points = positions.iter();
        let points = points.map(|at| DVec3::from_array(at.map(f64::from)));
        Some(Self {
            aabb,
            roundness: bounds.roundness(points),
        })
    }
}
