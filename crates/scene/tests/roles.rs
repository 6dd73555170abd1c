//! Entities that are not tested, images that change, and the environment: each change is reported by the update.
#![allow(clippy::unwrap_used)]

use antumbra_scene::{
    Drawable, Environment, Geometry, Image, ImageKey, Material, Mesh, Sampler, Scene, SceneError,
};
use glam::DAffine3;

fn image(shade: u8) -> Image {
    Image {
        name: "shade".into(),
        width: 2,
        height: 1,
        rgba: vec![shade; 8],
        sampler: Sampler::default(),
    }
}

fn scene() -> (Scene, antumbra_scene::EntityKey) {
    let mut scene = Scene::new();
    let triangle = Geometry {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        indices: vec![0, 1, 2],
        ..Geometry::default()
    };
    let mesh = scene.add_mesh(Mesh::new("triangle", triangle)).unwrap();
    let material = scene.add_material(Material::default());
    let entity = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    let drawable = Drawable { mesh, material };
    scene.set_drawable(entity, drawable).unwrap();
    scene.update();
    (scene, entity)
}

#[test]
fn an_entity_is_tested_until_told_otherwise() {
    let (mut scene, entity) = scene();
    assert!(scene.is_tested(entity));
    scene.set_tested(entity, false).unwrap();
    assert!(!scene.is_tested(entity));
    let changes = scene.update();
    assert_eq!(
        (&changes.removed, &changes.added),
        (&vec![entity], &vec![entity])
    );
    scene.set_tested(entity, false).unwrap();
    assert!(scene.update().is_empty());
}

#[test]
fn a_removed_entity_leaves_no_role_behind() {
    let (mut scene, entity) = scene();
    scene.set_tested(entity, false).unwrap();
    scene.despawn(entity);
    assert!(scene.set_tested(entity, false).is_err());
}

#[test]
fn an_image_that_changes_is_reported_once() {
    let (mut scene, _) = scene();
    let key = scene.add_image(image(1)).unwrap();
    assert!(scene.update().images.is_empty());
    scene.set_image(key, image(2)).unwrap();
    scene.set_image(key, image(3)).unwrap();
    assert_eq!(scene.update().images, [key]);
    assert_eq!(scene.image(key).unwrap().rgba[0], 3);
    assert!(scene.update().is_empty());
}

#[test]
fn an_image_refuses_pixels_that_do_not_fit_it() {
    let (mut scene, _) = scene();
    let key = scene.add_image(image(1)).unwrap();
    let short = Image {
        rgba: vec![0; 7],
        ..image(0)
    };
    assert!(scene.set_image(key, short).is_err());
    assert!(scene.set_image(ImageKey::default(), image(0)).is_err());
    assert_eq!(scene.image(key).unwrap().rgba[0], 1);
}

#[test]
fn another_environment_is_reported_once() {
    let (mut scene, _) = scene();
    let image = scene.add_image(image(1)).unwrap();
    assert!(!scene.update().environment);
    let around = |intensity| Some(Environment { image, intensity });
    for environment in [around(1.0), around(2.0), None] {
        scene.set_environment(environment).unwrap();
        assert_eq!(scene.environment(), environment);
        let changes = scene.update();
        assert!(changes.environment && !changes.is_empty());
        scene.set_environment(environment).unwrap();
        assert!(scene.update().is_empty(), "the same again is no change");
    }
    for intensity in [-1.0, f32::NAN, f32::INFINITY] {
        let error = scene.set_environment(around(intensity)).unwrap_err();
        assert!(
            matches!(error, SceneError::BadEnvironment { .. }),
            "{error}"
        );
    }
    let mut other = Scene::new();
    let error = other.set_environment(around(1.0)).unwrap_err();
    assert!(matches!(error, SceneError::UnknownAsset { .. }), "{error}");
    assert!(scene.update().is_empty() && other.update().is_empty());
}
