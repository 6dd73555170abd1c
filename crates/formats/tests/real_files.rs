//! Files written by other programs. They are not part of the repository: without the git-ignored folder `data/` these
//! tests print a note and pass. `apt-get download assimp-testmodels && dpkg -x assimp-testmodels_*.deb data/assimp`
//! and `scripts/data.sh city` fetch them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_formats::{LoadOptions, LoadProblem, SceneFormat, load, load_with_attachments};
use std::path::{Path, PathBuf};

fn models() -> Option<PathBuf> {
    let folder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/assimp/usr/share/assimp/models");
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: {} is not there", folder.display());
    None
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files(&path, found);
        } else if path
            .extension()
            .and_then(|e| SceneFormat::from_extension(e.to_str()?))
            .is_some()
        {
            found.push(path);
        }
    }
}

/// Every file gives a scene with content or an error that names the file; most files are readable.
#[test]
fn every_file_gives_a_scene_or_a_reason() {
    let Some(folder) = models() else { return };
    let mut all = Vec::new();
    files(&folder, &mut all);
    let mut refused = Vec::new();
    for path in &all {
        match load(path, &LoadOptions::default()) {
            Ok(mut scene) => {
                scene.update();
                println!(
                    "{}: {scene:?}",
                    path.strip_prefix(&folder).unwrap().display()
                );
                if scene.drawable_count() > 0 {
                    assert!(scene.bounds().is_some(), "{}", path.display());
                }
            }
            Err(error) => {
                let text = error.to_string();
                assert!(text.contains(path.to_str().unwrap()), "{text}");
                assert!(text.len() < 1000, "{text}");
                refused.push(text.replace(folder.to_str().unwrap(), ""));
            }
        }
    }
    println!(
        "{} of {} refused:\n{}",
        refused.len(),
        all.len(),
        refused.join("\n")
    );
    // A third of the collection is outdated, broken on purpose, or compressed.
    assert!(refused.len() * 5 < all.len() * 2, "too many refused");
}

#[test]
fn the_engine_has_the_parts_it_is_known_to_have() {
    let Some(folder) = models() else { return };
    let path = folder.join("glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb");
    let mut scene = load(&path, &LoadOptions::default()).unwrap();
    assert_eq!(scene.name(), "2CylinderEngine");
    assert_eq!(scene.triangle_count(), 121_496);
    assert_eq!(scene.update().added.len(), scene.drawable_count());
    let is_part = |name: &str| name.contains(", primitive ");
    let nodes: Vec<_> = (scene.entities())
        .filter(|e| !is_part(scene.entity_name(*e)))
        .collect();
    assert_eq!(nodes.len(), 82);
    let placed = nodes.iter().filter(|node| {
        let drawn_below = scene
            .children(**node)
            .any(|c| is_part(scene.entity_name(c)));
        scene.drawable(**node).is_some() || drawn_below
    });
    assert_eq!(placed.count(), 67);
    let meshes: std::collections::BTreeSet<_> = (scene.meshes())
        .map(|(_, mesh)| mesh.name.split(", primitive ").next().unwrap().to_owned())
        .collect();
    assert_eq!(meshes.len(), 29);
}

#[test]
fn more_triangles_than_allowed_are_refused() {
    let Some(folder) = models() else { return };
    let path = folder.join("glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb");
    let options = LoadOptions {
        max_triangles: 10_000,
        ..LoadOptions::default()
    };
    let error = load(&path, &options).unwrap_err();
    assert!(
        matches!(*error.problem, LoadProblem::TooLarge { .. }),
        "{error}"
    );
}

#[test]
fn delft_has_the_buildings_and_triangles_it_is_known_to_have() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/delft.city.jsonl");
    if !path.is_file() {
        eprintln!("skipped: {} is not there", path.display());
        return;
    }
    let mut scene = load(&path, &LoadOptions::default()).unwrap();
    scene.update();
    assert_eq!(scene.roots().count(), 1115);
    assert_eq!((scene.len(), scene.drawable_count()), (2231, 1116));
    // Triangles of polygons with holes: corners plus twice the holes, minus two each.
    let known = [109_101, 59_472, 40_592];
    let mut triangles = [0; 3];
    let mut open = 0;
    for (_, mesh) in scene.meshes() {
        assert_eq!(mesh.levels.len(), 3, "{}", mesh.name);
        for (sum, level) in triangles.iter_mut().zip(&mesh.levels) {
            *sum += level.triangle_count();
            let (mut all, mut size) = (glam::DVec3::ZERO, 0.0);
            for [a, b, c] in level.triangles().map(|t| level.corners(t).unwrap()) {
                let area = (b - a).cross(c - a);
                all += area;
                size += area.length();
            }
            // The areas of a closed surface towards opposite sides are equal.
            open += usize::from(all.length() > size * 1e-4);
        }
    }
    println!("{triangles:?} of {known:?} triangles, {open} meshes not closed");
    for (have, known) in triangles.into_iter().zip(known) {
        assert!(have.abs_diff(known) * 100 < known, "{have} of {known}");
    }
    assert!(open < 10, "{open} meshes have holes");
    let bounds = scene.bounds().unwrap();
    let (low, high) = (bounds.min.round(), bounds.max.round());
    assert_eq!(low.to_array(), [84_502.0, -4.0, -446_983.0]);
    assert_eq!(high.to_array(), [85_675.0, 95.0, -445_805.0]);
}

/// A skin and a morph target of other programs play, and their boxes change with them. `scripts/data.sh engine` fetches them.
#[test]
fn animated_files_move() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/assimp-testmodels/glTF2");
    for name in [
        "simple_skin/simple_skin.gltf",
        "glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf",
    ] {
        let file = folder.join(name);
        if !file.is_file() {
            eprintln!("skipped: {} is not there", file.display());
            continue;
        }
        let strict = LoadOptions {
            strict: true,
            ..LoadOptions::default()
        };
        let loaded = load_with_attachments(&file, &strict, &[]).unwrap();
        let (mut scene, animation) = (loaded.scene, loaded.animation.unwrap());
        assert_eq!(animation.meshes().len(), 1, "{name}");
        let boxes = [0.0, 0.7, 1.5].map(|time| {
            animation.pose(&mut scene, 0, time).unwrap();
            scene.update();
            scene.bounds().unwrap()
        });
        assert!(
            boxes[0] != boxes[1] && boxes[1] != boxes[2],
            "{name}: {boxes:?}"
        );
    }
}
