//! A single layer of boxes that hide nothing: what a culling strategy costs where there is nothing to cull.

use super::DemoSceneError;
use antumbra_scene::{Aabb, Drawable, Geometry, Material, Mesh, Scene};
use glam::{DAffine3, DVec3};

/// The most boxes along an edge.
const MOST: u32 = 10_000;
/// Edge of a box in metres.
const EDGE: f64 = 0.8;

/// `side` x `side` boxes of 0.8 m, 1 m apart around the origin in the plane z = 0, one mesh and one material; a directional light. No hierarchy, and
/// from before or behind none of them is hidden: 12 triangles each.
///
/// # Errors
/// [`DemoSceneError::TooLarge`] beyond a hundred million boxes.
pub fn layer(side: u32) -> Result<Scene, DemoSceneError> {
    if side > MOST {
        return Err(DemoSceneError::TooLarge {
            name: "layer",
            size: side,
            most: u64::from(MOST) * u64::from(MOST),
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
