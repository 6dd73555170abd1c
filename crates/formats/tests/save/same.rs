//! A round trip through a file, and the comparison of two scenes.

use antumbra_formats::{LoadOptions, load, save_glb};
use antumbra_scene::{Drawable, EntityKey, Light, Material, Scene};
use std::path::PathBuf;
use tempfile::TempDir;

/// Saves a scene, checks the file with the `gltf` crate, and loads it; removes the folder.
pub fn round_trip(scene: &Scene) -> (Scene, gltf::Gltf, TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("{}.glb", scene.name()));
    save_glb(scene, &path).unwrap();
    let names: Vec<PathBuf> = (folder.path().read_dir().unwrap())
        .map(|entry| entry.unwrap().path())
        .collect();
    assert_eq!(names, [path.as_path()], "nothing but the file is left");
    let bytes = std::fs::read(&path).unwrap();
    assert!(bytes.len().is_multiple_of(4));
    let document = gltf::Gltf::from_slice(&bytes).unwrap();
    for view in document.views() {
        assert!(view.offset().is_multiple_of(4));
    }
    let scene = load(&path, &LoadOptions::default()).unwrap();
    (scene, document, folder)
}

/// Compares two scenes completely. Translations are equal to the bit; rotations and scales may differ by the rounding
/// of their decomposition.
pub fn assert_same(a: &Scene, b: &Scene) {
    assert_eq!(a.name(), b.name());
    assert_eq!(a.len(), b.len());
    let mut pairs: Vec<(EntityKey, EntityKey)> = a.roots().zip(b.roots()).collect();
    assert_eq!(a.roots().count(), b.roots().count());
    while let Some((x, y)) = pairs.pop() {
        let name = a.entity_name(x);
        assert_eq!(name, b.entity_name(y));
        let (p, q) = (a.local(x).unwrap(), b.local(y).unwrap());
        assert_eq!(p.translation, q.translation, "{name}");
        let size = p
            .matrix3
            .to_cols_array()
            .into_iter()
            .fold(1.0, |most: f64, n| most.max(n.abs()));
        assert!(
            p.matrix3.abs_diff_eq(q.matrix3, size * 1e-11),
            "{name}: {p} became {q}"
        );
        assert_eq!(a.is_tested(x), b.is_tested(y), "{name}");
        match (a.drawable(x), b.drawable(y)) {
            (Some(p), Some(q)) => assert_same_drawable(a, p, b, q),
            (p, q) => assert_eq!(p.is_some(), q.is_some(), "{name}"),
        }
        assert_eq!(a.children(x).count(), b.children(y).count(), "{name}");
        pairs.extend(a.children(x).zip(b.children(y)));
    }
    let lights = |scene: &Scene| -> Vec<(String, Light)> {
        let lights = scene.lights();
        let mut lights: Vec<_> = lights
            .map(|placed| (scene.entity_name(placed.entity).to_owned(), placed.light))
            .collect();
        lights.sort_by(|a, b| a.0.cmp(&b.0));
        lights
    };
    assert_eq!(lights(a), lights(b));
}

fn assert_same_drawable(a: &Scene, p: Drawable, b: &Scene, q: Drawable) {
    let (mesh, other) = (a.mesh(p.mesh).unwrap(), b.mesh(q.mesh).unwrap());
    assert_eq!(mesh, other);
    let (mut material, mut other) = (
        a.material(p.material).unwrap().clone(),
        b.material(q.material).unwrap().clone(),
    );
    let image = |scene: &Scene, material: &mut Material| {
        let key = material.base_colour_image.take()?;
        Some(scene.image(key).unwrap().clone())
    };
    assert_eq!(image(a, &mut material), image(b, &mut other));
    for (row, again) in material.uv_transform.iter_mut().zip(other.uv_transform) {
        for (number, again) in row.iter_mut().zip(again) {
            assert!((*number - again).abs() < 1e-5, "{number} became {again}");
            *number = again;
        }
    }
    assert_eq!(material, other);
}
