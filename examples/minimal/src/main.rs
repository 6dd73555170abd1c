//! The smallest program that culls: no optional feature, and so no C++ compiler, no file loader and no command line.

use antumbra::glam::{DAffine3, DVec3};
use antumbra::prelude::*;
use antumbra::scene::{Aabb, Drawable, Geometry, Material, Mesh, icosphere};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::new();
    let material = scene.add_material(Material::default());
    let wall = Geometry::from_box(&Aabb::from_centre(DVec3::ZERO, DVec3::new(4.0, 2.0, 0.1)));
    let meshes = [("wall", wall), ("ball", icosphere(2, 0.4))]
        .map(|(name, geometry)| Mesh::new(name, geometry));
    let [wall, ball] = meshes.map(|mesh| scene.add_mesh(mesh));
    let balls = (-20..=20).map(|x| (DVec3::new(f64::from(x), 0.0, -3.0), ball.clone()));
    for (place, mesh) in balls.chain([(DVec3::ZERO, wall.clone())]) {
        let entity = scene.spawn(None, DAffine3::from_translation(place))?;
        scene.set_drawable(
            entity,
            Drawable {
                mesh: mesh?,
                material,
            },
        )?;
    }
    let on_gpu = GpuScene::new(&Gpu::open(&AdapterChoice::Auto)?, &mut scene)?;
    let views = vec![ViewSpec::main(640, 480)];
    let mut stage = Stage::new(
        &on_gpu,
        Box::new(FrustumOnly),
        views,
        StageOptions::default(),
    )?;
    let projection = Projection::Perspective {
        fov_y: 0.8,
        near: 0.1,
    };
    let camera = Camera::look_at(DVec3::Z * 8.0, DVec3::ZERO, DVec3::Y, projection)?;
    stage.frame(&on_gpu, &[ViewInput::new(camera)])?;
    let drawn = stage.verdicts(0, &on_gpu)?.drawn().count();
    println!("{drawn} of {} entities are drawn", scene.drawable_count());
    Ok(())
}
