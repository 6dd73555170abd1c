//! OBJ, PLY and STL: the content of files is read; built-in scenes survive a round trip.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_demo_scenes as demo_scenes;
use antumbra_demo_scenes::GridOptions;
use antumbra_formats::{LoadOptions, SceneFormat, load, load_slice};
use antumbra_scene::{Scene, Topology};
use glam::DVec3;

fn read(format: SceneFormat, bytes: &[u8]) -> Scene {
    load_slice(format, bytes, None, &LoadOptions::default()).unwrap()
}

#[test]
fn obj_has_objects_attributes_and_material_libraries() {
    let scene = read(SceneFormat::Obj, common::OBJ.as_bytes());
    assert_eq!(scene.triangle_count(), 3);
    let (_, mesh) = scene.meshes().next().unwrap();
    assert_eq!(mesh.name, "square");
    let folder = tempfile::tempdir().unwrap();
    let text = "newmtl red\nKd 0.5 0 0\nd 0.25\nmap_Kd red.png\n";
    std::fs::write(folder.path().join("none.mtl"), text).unwrap();
    std::fs::write(folder.path().join("red.png"), common::PNG).unwrap();
    std::fs::write(folder.path().join("square.obj"), common::OBJ).unwrap();
    let scene = load(&folder.path().join("square.obj"), &LoadOptions::default()).unwrap();
    assert_eq!(scene.name(), "square");
    let (_, red) = scene.materials().next().unwrap();
    assert_eq!(red.base_colour, [0.5, 0.0, 0.0, 0.25]);
    assert_eq!(scene.images().next().unwrap().1.width, 2);
    let outside = text.replace("red.png", "../red.png");
    std::fs::write(folder.path().join("none.mtl"), outside).unwrap();
    let scene = load(&folder.path().join("square.obj"), &LoadOptions::default()).unwrap();
    assert_eq!(
        scene.images().count(),
        0,
        "nothing outside the folder is opened"
    );
    assert_eq!(scene.triangle_count(), 3);
}

#[test]
fn ply_has_vertices_faces_and_colours_in_every_encoding() {
    let scene = read(SceneFormat::Ply, common::PLY.as_bytes());
    let (_, mesh) = scene.meshes().next().unwrap();
    assert_eq!(mesh.levels[0].indices, [0, 1, 2, 0, 2, 3]);
    assert_eq!(mesh.levels[0].colours[0], [255, 0, 0, 255]);
    let little = read(SceneFormat::Ply, &common::ply_binary());
    let (_, mesh) = little.meshes().next().unwrap();
    assert_eq!(mesh.levels[0].indices, [0, 1, 2]);
    assert_eq!(mesh.levels[0].positions[1], [1.0, 0.0, 0.0]);
    let points = common::PLY.replace("element face 1", "element face 0");
    let points = points.replace("4 0 1 2 3\n", "");
    let scene = read(SceneFormat::Ply, points.as_bytes());
    let (_, mesh) = scene.meshes().next().unwrap();
    assert_eq!(mesh.levels[0].topology, Topology::Points);
}

#[test]
fn stl_is_told_by_its_length_not_by_its_first_word() {
    for (bytes, triangles, vertices) in [
        (common::STL.as_bytes().to_vec(), 1, 3),
        (common::STL.replace("solid one", "solid").into_bytes(), 1, 3),
        (common::stl_binary(b"made here", 2), 2, 3),
        (common::stl_binary(b"solid but binary", 2), 2, 3),
        (common::stl_binary(b"", 0), 0, 0),
    ] {
        let scene = read(SceneFormat::Stl, &bytes);
        assert_eq!(scene.triangle_count(), triangles);
        let (_, mesh) = scene.meshes().next().unwrap();
        assert_eq!(
            mesh.levels[0].positions.len(),
            vertices,
            "equal corners are one vertex"
        );
    }
}

#[test]
fn the_grid_is_what_it_says() {
    let mut scene = demo_scenes::by_name("grid", None).unwrap();
    assert_eq!(scene.drawable_count(), 17_576);
    assert_eq!(scene.mesh_count(), 1);
    let (_, mesh) = scene.meshes().next().unwrap();
    let sphere = &mesh.levels[0];
    assert_eq!(
        (sphere.triangle_count(), sphere.positions.len()),
        (320, 162)
    );
    for triangle in sphere.triangles() {
        let [a, b, c] = sphere.corners(triangle).unwrap();
        assert!(
            (b - a).cross(c - a).dot(a + b + c) > 0.0,
            "counter-clockwise from outside"
        );
    }
    for position in &sphere.positions {
        assert!((glam::Vec3::from(*position).length() - 0.45).abs() < 1e-6);
    }
    assert_eq!(scene.lights().count(), 1);
    scene.update();
    let bounds = scene.bounds().unwrap();
    let most = 12.5 + 0.1 + 0.45;
    assert!(bounds.half_extents().max_element() <= most + 1e-6);
    assert!(bounds.half_extents().min_element() > 12.5);
    let options = GridOptions {
        per_side: 3,
        seed: 7,
    };
    let place = |scene: &Scene| -> Vec<DVec3> {
        scene
            .drawables()
            .map(|(e, _)| scene.world(e).unwrap().translation)
            .collect()
    };
    let (a, b) = (
        demo_scenes::grid(options).unwrap(),
        demo_scenes::grid(options).unwrap(),
    );
    assert_eq!(place(&a), place(&b), "one seed, one scene");
    let other = demo_scenes::grid(GridOptions { seed: 8, ..options }).unwrap();
    assert_ne!(place(&a), place(&other));
}

#[test]
fn unknown_built_in_names_list_the_known_ones() {
    let text = demo_scenes::by_name("gird", None).unwrap_err().to_string();
    assert!(text.contains("gird") && text.contains("grid"), "{text}");
    assert!(demo_scenes::by_name("grid", Some(u32::MAX)).is_err());
    assert_eq!(
        demo_scenes::by_name("grid", Some(0))
            .unwrap()
            .drawable_count(),
        0
    );
}
