//! Checks that a scene shows a terrain as it was prepared: the same triangles at the same positions. Otherwise its horizons would be those of
//! another surface.

use std::collections::HashSet;

use antumbra_scene::{EntityKey, Scene, Topology};
use glam::DAffine3;

use super::problem::bad;
use crate::error::TerrainError;
use crate::show::{IndexedTriangles, ShownTerrain, indexed, mesh_position};
use crate::terrain::Terrain;
use crate::world::to_world;

/// Refuses the first entity that shows other triangles or was moved.
pub(super) fn check_scene(
    terrain: &Terrain,
    scene: &Scene,
    shown: &ShownTerrain,
) -> Result<(), TerrainError> {
    let groups = terrain.groups();
    let of_groups = shown.groups.iter().map(|shown| {
        let group = groups.groups().get(shown.group as usize);
        let triangles = group.map_or(&[][..], |group| groups.triangles(group));
        (shown.entity, triangles)
    });
    let ungrouped = shown.ungrouped.iter();
    let ungrouped = ungrouped.map(|shown| (shown.entity, shown.triangles.as_slice()));
    let expected = DAffine3::from_translation(to_world(terrain.field().origin()));
    if scene.world(shown.root) != Some(expected) {
        let name = scene.describe(shown.root);
        return Err(bad(format!(
            "{name} does not stand where the terrain was prepared"
        )));
    }
    let mut known = HashSet::new();
    for (entity, triangles) in of_groups.chain(ungrouped) {
        if !known.insert(entity) {
            let name = scene.describe(entity);
            return Err(bad(format!("{name} is named for two parts of the terrain")));
        }
        // Only the parent is compared: a walk up to the root would take as long as the scene is deep.
        let is_child = scene.parent(entity) == Some(shown.root);
        if !is_child || scene.local(entity) != Some(DAffine3::IDENTITY) {
            let name = scene.describe(entity);
            return Err(bad(format!("{name} was moved, or has another parent")));
        }
        check_entity(terrain, scene, entity, triangles)?;
    }
    Ok(())
}

/// Refuses an entity that does not show exactly these triangles.
fn check_entity(
    terrain: &Terrain,
    scene: &Scene,
    entity: EntityKey,
    triangles: &[u32],
) -> Result<(), TerrainError> {
    let field = terrain.field();
    let wrong = |problem: &str| Err(bad(format!("{} {problem}", scene.describe(entity))));
    let mesh = scene.drawable(entity).and_then(|it| scene.mesh(it.mesh));
    if scene
        .drawable(entity)
        .is_some_and(|it| scene.deforms(it.mesh))
    {
        return wrong("has a mesh that an animation deforms");
    }
    let Some([mesh]) = mesh.map(|mesh| mesh.levels.as_slice()) else {
        return wrong("has no mesh of its part of the terrain, or a mesh with coarser levels");
    };
    let IndexedTriangles { vertices, indices } = indexed(field, triangles);
    let positions = vertices.iter().map(|&vertex| mesh_position(field, vertex));
    let same = mesh.topology == Topology::Triangles
        && mesh.indices == indices
        && positions.eq(mesh.positions.iter().copied());
    if same {
        return Ok(());
    }
    wrong("shows other triangles than were prepared")
}
