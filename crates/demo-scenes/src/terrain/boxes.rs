//! Boxes of many sizes at random places on a terrain.

use crate::random::{Random, Stream};
use antumbra_scene::{Aabb, Drawable, Geometry, Material, Mesh, Scene};
use antumbra_terrain::{Terrain, TerrainError, to_world};
use glam::{DAffine3, DQuat, DVec2, DVec3};

/// Adds `count` boxes to the scene: 5 to 40 metres wide, 3 to 30 metres high, rotated at random, one metre in the
/// ground.
pub(crate) fn spread_boxes(
    scene: &mut Scene,
    terrain: &Terrain,
    count: usize,
    seed: u64,
) -> Result<(), TerrainError> {
    if count == 0 {
        return Ok(());
    }
    let base = Aabb::new(DVec3::new(-0.5, 0.0, -0.5), DVec3::new(0.5, 1.0, 0.5));
    let mesh = scene.add_mesh(Mesh::new("box", Geometry::from_box(&base)))?;
    let material = scene.add_material(Material {
        name: "boxes".to_owned(),
        base_colour: [0.62, 0.3, 0.2, 1.0],
        ..Material::default()
    });
    let root = scene.spawn(None, DAffine3::IDENTITY)?;
    scene.set_entity_name(root, "boxes")?;
    let mut random = Random::new(seed, Stream::Boxes);
    let [low, high] = terrain.field().plan_bounds();
    for at in 0..count {
        let place = DVec2::new(random.between(low.x, high.x), random.between(low.y, high.y));
        let size = DVec3::new(
            random.between(5.0, 40.0),
            random.between(3.0, 30.0),
            random.between(5.0, 40.0),
        );
        let rotation = DQuat::from_rotation_y(random.angle());
        // In a hole of the field a box stands at height 0.
        let ground = terrain.height(place).unwrap_or_default() - 1.0;
        let origin = terrain.field().origin();
        let position = to_world(place.extend(ground) + origin);
        let local = DAffine3::from_scale_rotation_translation(size, rotation, position);
        let entity = scene.spawn(Some(root), local)?;
        scene.set_entity_name(entity, format!("box {at}"))?;
        scene.set_drawable(entity, Drawable { mesh, material })?;
    }
    Ok(())
}
