//! Antumbra's scenes as Bevy entities: a mesh and a material for each of theirs, an entity for each that is drawn.

use antumbra::scene as ours;
use bevy::asset::RenderAssetUsages;
use bevy::math::Affine3A;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::platform::collections::HashMap;
use bevy::prelude::*;

/// Spawns what a scene draws, and its directional lights.
pub fn spawn(app: &mut App, scene: &ours::Scene) {
    let world = app.world_mut();
    let mut meshes = HashMap::new();
    let mut assets = world.resource_mut::<Assets<Mesh>>();
    for (key, theirs) in scene.meshes() {
        meshes.insert(key, assets.add(mesh(&theirs.levels[0])));
    }
    let mut materials = HashMap::new();
    let mut assets = world.resource_mut::<Assets<StandardMaterial>>();
    for (key, theirs) in scene.materials() {
        materials.insert(key, assets.add(material(theirs)));
    }
    for (entity, drawable) in scene.drawables() {
        let Some(place) = scene.world(entity) else {
            continue;
        };
        world.spawn((
            Mesh3d(meshes[&drawable.mesh].clone()),
            MeshMaterial3d(materials[&drawable.material].clone()),
            transform(place.to_cols_array()),
        ));
    }
    for placed in scene.lights() {
        if let ours::Light::Directional { .. } = placed.light {
            let light = DirectionalLight {
                illuminance: 5_000.0,
                ..default()
            };
            world.spawn((light, transform(placed.world.to_cols_array())));
        }
    }
}

fn transform(columns: [f64; 12]) -> Transform {
    let columns = columns.map(|number| number as f32);
    Transform::from_matrix(Mat4::from(Affine3A::from_cols_array(&columns)))
}

fn mesh(geometry: &ours::Geometry) -> Mesh {
    let mut mesh = Mesh::new(
        PrimitiveTopology::TriangleList,
        RenderAssetUsages::default(),
    );
    mesh.insert_attribute(Mesh::ATTRIBUTE_POSITION, geometry.positions.clone());
    mesh.insert_indices(Indices::U32(geometry.indices.clone()));
    if geometry.normals.is_empty() {
        mesh.compute_smooth_normals();
    } else {
        mesh.insert_attribute(Mesh::ATTRIBUTE_NORMAL, geometry.normals.clone());
    }
    mesh
}

fn material(theirs: &ours::Material) -> StandardMaterial {
    let [red, green, blue, alpha] = theirs.base_colour;
    StandardMaterial {
        base_color: Color::linear_rgba(red, green, blue, alpha),
        perceptual_roughness: theirs.roughness,
        metallic: theirs.metallic,
        double_sided: theirs.double_sided,
        cull_mode: (!theirs.double_sided).then_some(wgpu::Face::Back),
        unlit: theirs.unlit,
        ..default()
    }
}
