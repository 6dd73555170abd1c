//! Materials of glTF that show otherwise than by a base colour: emission, and specular-glossiness.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_formats::{LoadOptions, SceneFormat, load, load_slice, save_glb};
use antumbra_scene::{Material, Scene};

fn read(materials: &str) -> Scene {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},{},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],"nodes":[{{"mesh":0}}],"materials":[{materials}]{IMAGE}}}"#,
        common::SQUARE
    );
    let file = common::glb(&json, &common::square());
    load_slice(SceneFormat::Gltf, &file, None, &LoadOptions::default()).unwrap()
}

fn look(materials: &str) -> Material {
    read(materials).materials().next().unwrap().1.clone()
}

const IMAGE: &str = r#","textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAD0lEQVR4nGP4z8DwHwgbABB5A359Y87XAAAAAElFTkSuQmCC"}]"#;

#[test]
fn emission_has_a_factor_and_a_strength() {
    let black = r#""pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]}"#;
    assert_eq!(
        look(&format!(r#"{{{black},"emissiveFactor":[0,1,0]}}"#)).emission,
        [0.0, 1.0, 0.0]
    );
    let strong = look(
        r#"{"emissiveFactor":[0.5,1,0],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}}}"#,
    );
    assert_eq!(strong.emission, [2.0, 4.0, 0.0]);
}

#[test]
fn a_surface_that_only_glows_shows_its_image() {
    let light = look(
        r#"{"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]},"emissiveFactor":[1,0.5,1],"emissiveTexture":{"index":0}}"#,
    );
    assert!(light.unlit && light.base_colour_image.is_some());
    assert_eq!(light.base_colour, [1.0, 0.5, 1.0, 1.0]);
    assert_eq!(light.emission, [0.0; 3]);
    // An image that the factor turns off shows nothing.
    let off = look(r#"{"emissiveTexture":{"index":0}}"#);
    assert_eq!((off.emission, off.unlit), ([0.0; 3], false));
}

#[test]
fn specular_glossiness_is_shown_by_its_diffuse_part() {
    let red = look(
        r#"{"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[1,0,0,0.5],"glossinessFactor":0.25,"diffuseTexture":{"index":0}}}}"#,
    );
    assert_eq!(red.base_colour, [1.0, 0.0, 0.0, 0.5]);
    assert_eq!((red.metallic, red.roughness), (0.0, 0.75));
    assert!(red.base_colour_image.is_some());
}

#[test]
fn emission_survives_saving() {
    let folder = tempfile::tempdir().unwrap();
    for emission in ["[0,1,0.25]", "[1,0.5,0]"] {
        let strength = r#""extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":2}}"#;
        let scene = read(&format!(r#"{{"emissiveFactor":{emission},{strength}}}"#));
        let path = folder.path().join("a.glb");
        save_glb(&scene, &path).unwrap();
        let again = load(&path, &LoadOptions::default()).unwrap();
        let emission = |scene: &Scene| scene.materials().next().unwrap().1.emission;
        assert_eq!(emission(&scene), emission(&again));
    }
}
