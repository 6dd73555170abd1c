//! Whether a scene shows a terrain as it was prepared: the same triangles at the same places. Horizons of anything else would be true of
//! another surface.

use std::collections::HashSet;

use antumbra_scene::{EntityKey, Scene, Topology};
use glam::DAffine3;

use super::bad;
use crate::error::TerrainError;
use crate::show::{ShownTerrain, corners, position, to_world};
use crate::terrain::Terrain;

/// Refuses the first entity that shows something else, or stands elsewhere.
pub(super) fn agrees(
    terrain: &Terrain,
    scene: &Scene,
    shown: &ShownTerrain,
) -> Result<(), TerrainError> {
    let groups = terrain.groups();
    let crystals = shown.groups.iter().map(|&(entity, group)| {
        let group = groups.groups().get(group as usize);
        (
            entity,
            group.map_or(&[][..], |group| groups.triangles(group)),
        )
    });
    let always = shown.always.iter();
    let always = always.map(|(entity, triangles)| (*entity, triangles.as_slice()));
    let place = DAffine3::from_translation(to_world(terrain.field().origin()));
    if scene.world(shown.root) != Some(place) {
        let name = scene.describe(shown.root);
        return Err(bad(format!(
            "{name} does not stand where the terrain was prepared"
        )));
    }
    let mut known = HashSet::new();
    for (entity, triangles) in crystals.chain(always) {
        if !known.insert(entity) {
            let name = scene.describe(entity);
            return Err(bad(format!("{name} is named for two parts of the terrain")));
        }
        // What hangs elsewhere could be walked up to for as long as the scene is deep.
        let below = scene.parent(entity) == Some(shown.root);
        if !below || scene.local(entity) != Some(DAffine3::IDENTITY) {
            let name = scene.describe(entity);
            return Err(bad(format!("{name} was moved, or hung elsewhere")));
        }
        is_as_shown(terrain, scene, entity, triangles)?;
    }
    Ok(())
}

fn is_as_shown(
    terrain: &Terrain,
    scene: &Scene,
    entity: EntityKey,
    triangles: &[u32],
) -> Result<(), TerrainError> {
    let field = terrain.field();
    let wrong = |problem: &str| Err(bad(format!("{} {problem}", scene.describe(entity))));
    let mesh = scene.drawable(entity).and_then(|it| scene.mesh(it.mesh));
    let Some([mesh]) = mesh.map(|mesh| mesh.levels.as_slice()) else {
        return wrong("has no mesh of its part of the terrain, or coarser versions of it");
    };
    let (vertices, indices) = corners(field, triangles);
    let positions = vertices.iter().map(|&vertex| position(field, vertex));
    let same = mesh.topology == Topology::Triangles
        && mesh.indices == indices
        && positions.eq(mesh.positions.iter().copied());
    if same {
        return Ok(());
    }
    wrong("shows other triangles than were prepared")
}
