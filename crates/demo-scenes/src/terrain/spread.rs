//! Boxes of all sizes, spread over a terrain by chance: something to stand on the built-in landscape.

use std::f64::consts::TAU;

use antumbra_scene::{Aabb, Drawable, Geometry, Material, Mesh, Scene};
use glam::{DAffine3, DQuat, DVec2, DVec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

use antumbra_terrain::{Terrain, TerrainError, to_world};

/// The sequence of chance that is for boxes.
const FOR_BOXES: u64 = 7;

/// Spreads boxes from 5 to 40 metres wide and 3 to 30 metres high, each turned somehow and a metre in the ground.
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
    let mut chance = Pcg32::new(seed, FOR_BOXES);
    let mut number = |low: f64, high: f64| {
        low + (high - low) * f64::from(chance.next_u32()) / f64::from(u32::MAX)
    };
    let [low, high] = terrain.field().plan_bounds();
    for at in 0..count {
        let place = DVec2::new(number(low.x, high.x), number(low.y, high.y));
        let size = DVec3::new(number(5.0, 40.0), number(3.0, 30.0), number(5.0, 40.0));
        let turned = DQuat::from_rotation_y(number(0.0, TAU));
        // In a hole, if there are any, it stands on what zero is.
        let ground = terrain.height(place).unwrap_or_default() - 1.0;
        let origin = terrain.field().origin();
        let stands = to_world(place.extend(ground) + origin);
        let local = DAffine3::from_scale_rotation_translation(size, turned, stands);
        let entity = scene.spawn(Some(root), local)?;
        scene.set_entity_name(entity, format!("box {at}"))?;
        scene.set_drawable(entity, Drawable { mesh, material })?;
    }
    Ok(())
}
