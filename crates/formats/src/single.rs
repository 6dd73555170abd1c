//! Entities of formats that say nothing of materials: white, and visible from both sides.

use crate::error::LoadProblem;
use antumbra_scene::{Drawable, Geometry, Material, Mesh, Scene};
use glam::DAffine3;

/// Adds an entity with this geometry. All of a scene share one material.
pub(crate) fn spawn(
    scene: &mut Scene,
    name: &str,
    geometry: Geometry,
    transform: DAffine3,
) -> Result<(), LoadProblem> {
    let known = scene.materials().next().map(|(key, _)| key);
    let material = known.unwrap_or_else(|| {
        scene.add_material(Material {
            // In such files the winding of triangles is not reliable.
            double_sided: true,
            ..Material::default()
        })
    });
    let mesh = scene.add_mesh(Mesh::new(name, geometry))?;
    let entity = scene.spawn(None, transform)?;
    scene.set_entity_name(entity, name)?;
    scene.set_drawable(entity, Drawable { mesh, material })?;
    Ok(())
}
