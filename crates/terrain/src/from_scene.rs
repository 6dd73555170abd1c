//! Fields out of scenes: all triangles, wherever their entities stand.

use std::collections::VecDeque;

use antumbra_scene::{EntityKey, Geometry, Scene, Topology};
use glam::{DAffine3, Vec3};

use crate::error::TerrainError;
use crate::field::Field;
use crate::show::from_world;

/// The most corners, and the most triangles: a mesh may stand in a scene any number of times.
const MOST: usize = 1 << 27;

impl Field {
    /// A field of all triangles of a scene, at full detail, with Y up and Z south made metres east, north and up: what
    /// a loader makes of a mesh's file. Lines and points are no part of it.
    ///
    /// Corners at one place are made one, to the last bit; meshes that were moved apart and back may no longer touch.
    ///
    /// # Errors
    /// [`TerrainError::NotAHeightField`] with every fault's place, metres east, north and up, and triangles numbered through all entities,
    /// those above first; [`TerrainError::TooMany`].
    pub fn of_scene(scene: &Scene) -> Result<Self, TerrainError> {
        let shown = shown(scene);
        let count = |each: fn(&Geometry) -> usize| {
            let counts = shown.iter().map(|(_, geometry)| each(geometry));
            counts.fold(0, usize::saturating_add)
        };
        for (what, count) in [
            ("corners", count(|geometry| geometry.positions.len())),
            ("triangles", count(Geometry::triangle_count)),
        ] {
            if count > MOST {
                let most = MOST;
                return Err(TerrainError::TooMany { what, count, most });
            }
        }
        let mut points = Vec::new();
        let mut triangles: Vec<[u32; 3]> = Vec::new();
        for (world, geometry) in shown {
            let first = points.len() as u32;
            let corners = geometry.positions.iter();
            points.extend(
                corners.map(|&corner| {
                    from_world(world.transform_point3(Vec3::from(corner).as_dvec3()))
                }),
            );
            let mirrored = world.matrix3.determinant() < 0.0;
            triangles.extend(geometry.triangles().map(|[a, b, c]| {
                let [b, c] = if mirrored { [c, b] } else { [b, c] };
                [a, b, c].map(|corner| first + corner)
            }));
        }
        Self::new(points, triangles)
    }
}

/// All triangle meshes that entities have, and where they stand, each entity after the one that it hangs below.
fn shown(scene: &Scene) -> Vec<(DAffine3, &Geometry)> {
    let mut shown = Vec::new();
    let mut open: VecDeque<(EntityKey, DAffine3)> = VecDeque::new();
    open.extend(scene.roots().map(|root| (root, DAffine3::IDENTITY)));
    while let Some((entity, above)) = open.pop_front() {
        let world = above * scene.local(entity).unwrap_or_default();
        let mesh = scene.drawable(entity).and_then(|it| scene.mesh(it.mesh));
        let full = mesh.and_then(|mesh| mesh.full());
        let triangles = full.filter(|full| full.topology == Topology::Triangles);
        shown.extend(triangles.map(|full| (world, full)));
        open.extend(scene.children(entity).map(|child| (child, world)));
    }
    shown
}
