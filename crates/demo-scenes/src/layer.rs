//! The scene `layer`: one layer of boxes that do not hide each other. It measures the cost of a culling strategy
//! where nothing can be culled.

use crate::error::DemoSceneError;
use antumbra_scene::{Aabb, Drawable, Geometry, Material, Mesh, Scene};
use glam::{DAffine3, DVec3};

/// Maximum number of boxes along an edge.
const MAX_SIDE: u32 = 10_000;
/// Edge of a box in metres.
const EDGE: f64 = 0.8;

/// Builds `side` x `side` boxes of 0.8 m and 12 triangles each, 1 m apart around the origin in the plane z = 0. They
/// share one mesh and one material; the scene has one directional light and no hierarchy. Seen along Z, no box hides
/// another.
///
/// # Errors
/// [`DemoSceneError::TooLarge`] for more than a hundred million boxes.
pub fn layer(side: u32) -> Result<Scene, DemoSceneError> {
    if side > MAX_SIDE {
        return Err(DemoSceneError::TooLarge {
            name: "layer",
            size: side,
            max_entities: u64::from(MAX_SIDE) * u64::from(MAX_SIDE),
        });
    }
    let mut scene = Scene::new();
    scene.set_name("layer");
    let bounds = Aabb::from_centre(DVec3::ZERO, DVec3::splat(EDGE * 0.5));
    let drawable = Drawable {
        mesh: scene.add_mesh(Mesh::new("box", Geometry::from_box(&bounds)))?,
        material: scene.add_material(Material {
            name: "white".into(),
            ..Material::default()
        }),
    };
    let middle = (f64::from(side) - 1.0) * 0.5;
    for y in 0..side {
        for x in 0..side {
            let place = DVec3::new(f64::from(x) - middle, f64::from(y) - middle, 0.0);
            let entity = scene.spawn(None, DAffine3::from_translation(place))?;
            scene.set_drawable(entity, drawable)?;
        }
    }
    super::sun::add(&mut scene, 0.5, -0.7)?;
    Ok(scene)
}
