//! `--path camera`: the cameras of a scene file.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::path::Path;

use antumbra::formats::save_glb;
use antumbra::glam::{DAffine3, DVec3};
use antumbra::scene::{Camera, Drawable, Light, Material, Mesh, Projection, Scene, icosphere};
use common::{refuses, succeeds};
use image::RgbImage;

/// A ball at the origin with three cameras: one before it, one that looks away, and one without a name.
fn scene() -> Scene {
    let mut scene = Scene::new();
    let mesh = scene
        .add_mesh(Mesh::new("ball", icosphere(2, 1.0)))
        .unwrap();
    let material = scene.add_material(Material::default());
    let ball = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    let drawable = Drawable { mesh, material };
    scene.set_drawable(ball, drawable).unwrap();
    let lamp = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    let light = Light::Directional {
        colour: [1.0; 3],
        illuminance: 3.0,
    };
    scene.set_light(lamp, light).unwrap();
    let projection = Projection::Perspective {
        fov_y: 0.8,
        near: 0.1,
    };
    // A camera's place is its entity's; scales above it do not zoom.
    for (name, place, turned) in [("near", 4.0, 0.0), ("away", 4.0, 3.0), ("", 40.0, 0.0)] {
        let place = DAffine3::from_translation(DVec3::Z * place)
            * DAffine3::from_rotation_y(turned)
            * DAffine3::from_scale(DVec3::splat(2.0));
        let entity = scene.spawn(None, place).unwrap();
        scene.set_entity_name(entity, name).unwrap();
        let camera = Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, projection).unwrap();
        scene.set_camera(entity, camera).unwrap();
    }
    scene
}

fn saved(folder: &Path, scene: &Scene) -> String {
    let file = folder.join("scene.glb");
    save_glb(scene, &file).unwrap();
    file.to_str().unwrap().to_owned()
}

/// How many of 3072 pixels the ball covers.
fn covered(folder: &Path, scene: &str, path: &str) -> usize {
    let file = folder.join("image.png");
    let image = file.to_str().unwrap();
    let arguments = [
        "render", scene, "--size", "64x48", "--path", path, "-o", image,
    ];
    succeeds(&arguments);
    let image: RgbImage = image::open(file).unwrap().into_rgb8();
    let sky = *image.get_pixel(0, 0);
    image.pixels().filter(|pixel| **pixel != sky).count()
}

#[test]
fn an_image_is_drawn_from_a_camera_of_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let scene = saved(folder.path(), &scene());
    let covered = |path| covered(folder.path(), &scene, path);
    let first = covered("camera");
    assert!((500..1500).contains(&first), "{first}");
    assert_eq!(covered("camera:near"), first);
    assert_eq!(covered("camera:away"), 0);
}

#[test]
fn every_command_that_draws_takes_a_camera() {
    let folder = tempfile::tempdir().unwrap();
    let scene = saved(folder.path(), &scene());
    let out = folder.path().join("out");
    let out = out.to_str().unwrap();
    let path = ["--path", "camera:near", "--frames", "2", "--size", "32x24"];
    let said = succeeds(
        &[
            &["compare", &scene, "--strategies", "frustum", "--out", out],
            &path[..],
        ]
        .concat(),
    );
    assert!(said.contains("near"), "{said}");
    let vary = [
        "--strategy",
        "three-pass",
        "--vary",
        "threshold=1",
        "--quiet",
    ];
    succeeds(&[&["sweep", &scene, "--out", out], &vary[..], &path].concat());
    succeeds(&[&["graph", &scene, "--strategy", "frustum"], &path[..]].concat());
}

#[test]
fn a_camera_that_is_not_there_is_refused_with_those_that_are() {
    let folder = tempfile::tempdir().unwrap();
    let scene = saved(folder.path(), &scene());
    let refused = |scene: &str, path: &str, words: &[&str]| {
        let arguments = ["graph", scene, "--strategy", "frustum", "--path", path];
        refuses(&arguments, 2, words);
    };
    refused(
        &scene,
        "camera:far",
        &["camera:far", "near, away, (without a name)"],
    );
    refused("grid:2", "camera", &["--path camera", "no camera"]);
    refused(
        "grid:2",
        "camera:near",
        &["--path camera:near", "no camera"],
    );
    refused("subsurface:100", "camera", &["no camera"]);
}
