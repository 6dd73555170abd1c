//! Fields from scenes: all triangles of all entities, in world coordinates.

use std::collections::VecDeque;

use antumbra_scene::{EntityKey, Geometry, Scene, Topology};
use glam::{DAffine3, Vec3};

use crate::error::TerrainError;
use crate::field::Field;
use crate::world::from_world;

/// The most corners, and the most triangles: a mesh may be in a scene any number of times.
const MOST: usize = 1 << 27;

impl Field {
    /// Makes a field of all triangles of a scene, at full detail: of what a loader makes of a mesh's file, for example. World coordinates, Y
    /// up and Z south, become metres east, north and up. Lines and points are ignored.
    ///
    /// Corners are welded if their positions are equal to the last bit. Meshes that were moved apart and back may no longer touch.
    ///
    /// # Errors
    /// [`TerrainError::NotAHeightField`] with every fault's position, metres east, north and up, and triangles numbered through all entities,
    /// parents before their children; [`TerrainError::TooMany`].
    pub fn from_scene(scene: &Scene) -> Result<Self, TerrainError> {
        let shown = shown(scene);
        let count = |each: fn(&Geometry) -> usize| {
            let counts = shown.iter().map(|placed| each(placed.geometry));
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
        for PlacedGeometry { world, geometry } in shown {
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

/// A triangle mesh in the world.
struct PlacedGeometry<'a> {
    world: DAffine3,
    geometry: &'a Geometry,
}

/// All triangle meshes of a scene's entities, parents before their children.
fn shown(scene: &Scene) -> Vec<PlacedGeometry<'_>> {
    let mut shown = Vec::new();
    let mut open: VecDeque<(EntityKey, DAffine3)> = VecDeque::new();
    open.extend(scene.roots().map(|root| (root, DAffine3::IDENTITY)));
    while let Some((entity, parent)) = open.pop_front() {
        let world = parent * scene.local(entity).unwrap_or_default();
        let mesh = scene.drawable(entity).and_then(|it| scene.mesh(it.mesh));
        let full = mesh.and_then(|mesh| mesh.full());
        let triangles = full.filter(|full| full.topology == Topology::Triangles);
        shown.extend(triangles.map(|geometry| PlacedGeometry { world, geometry }));
        open.extend(scene.children(entity).map(|child| (child, world)));
    }
    shown
}
