//! How round meshes are: what lies in the ellipsoid within its box is found hidden more often than what may fill it.

use bevy::camera::primitives::Aabb;
use bevy::mesh::VertexAttributeValues;
use bevy::platform::collections::HashMap;
use bevy::prelude::*;

/// The roundness of meshes, by asset.
#[derive(Default)]
pub(crate) struct Roundness {
    known: HashMap<AssetId<Mesh>, Shape>,
}

/// A mesh in its box.
#[derive(Clone, Copy)]
struct Shape {
    centre: Vec3A,
    half: Vec3A,
    roundness: f32,
}

impl Roundness {
    /// That of what may fill its box.
    pub const ANGULAR: f32 = 2.0;

    /// That of a mesh in a box, which counts only where it is the mesh's own.
    pub fn of(&mut self, id: AssetId<Mesh>, meshes: &Assets<Mesh>, aabb: &Aabb) -> f32 {
        let shape = self.known.get(&id).copied().or_else(|| {
            let shape = Shape::new(meshes.get(id)?)?;
            self.known.insert(id, shape);
            Some(shape)
        });
        let shape =
            shape.filter(|shape| shape.centre == aabb.center && shape.half == aabb.half_extents);
        shape.map_or(Self::ANGULAR, |shape| shape.roundness)
    }

    /// Forgets a mesh that is another one now.
    pub fn forget(&mut self, id: AssetId<Mesh>) {
        self.known.remove(&id);
    }
}

impl Shape {
    /// `None` for a mesh without positions in memory.
    fn new(mesh: &Mesh) -> Option<Self> {
        let Ok(VertexAttributeValues::Float32x3(positions)) =
            mesh.try_attribute(Mesh::ATTRIBUTE_POSITION)
        else {
            return None;
        };
        let aabb = Aabb::enclosing(positions.iter().copied().map(Vec3::from_array))?;
        // Along an axis without extent every vertex is in the middle.
        let inverse = Vec3A::select(
            aabb.half_extents.cmpgt(Vec3A::ZERO),
            aabb.half_extents.recip(),
            Vec3A::ZERO,
        );
        let squared = positions
            .iter()
            .map(|at| ((Vec3A::from_array(*at) - aabb.center) * inverse).length_squared());
        // Rounded up by more than f32 loses on the way.
        let roundness = squared.fold(0.0, f32::max).sqrt() * (1.0 + 1e-5);
        Some(Self {
            centre: aabb.center,
            half: aabb.half_extents,
            roundness,
        })
    }
}
