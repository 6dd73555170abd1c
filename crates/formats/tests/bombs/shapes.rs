//! OBJ, STL and PLY files that would become huge.

use super::{ALLOCATOR, MEMORY, common, options, refused, scene, turn};
use antumbra_formats::{LoadOptions, SceneFormat, load, load_slice, load_with_attachments};
use std::path::Path;

#[test]
fn a_material_library_is_read_once_however_often_it_is_named() {
    let _turn = turn();
    let folder = tempfile::tempdir().unwrap();
    let library: String = (0..10_000)
        .map(|i| format!("newmtl m{i}\nKd 1 0 0\n"))
        .collect();
    std::fs::write(folder.path().join("big.mtl"), library).unwrap();
    let path = folder.path().join("a.obj");
    let shape = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m7\nf 1 2 3\n";
    std::fs::write(&path, "mtllib big.mtl\n".repeat(1000) + shape).unwrap();
    let scene = load(&path, &options()).unwrap();
    assert_eq!(scene.materials().count(), 1);
}

#[test]
fn a_material_library_has_a_share_of_the_budget() {
    let _turn = turn();
    let folder = tempfile::tempdir().unwrap();
    let library: String = (0..200_000).map(|i| format!("newmtl {i}\n")).collect();
    std::fs::write(folder.path().join("big.mtl"), library).unwrap();
    let path = folder.path().join("a.obj");
    std::fs::write(&path, "mtllib big.mtl\nv 0 0 0\nf 1 1 1\n").unwrap();
    let load = |path: &Path| load(path, &options()).map_err(|error| error.to_string());
    refused(|| load(&path), &["material library \"big.mtl\"", "MiB"]);
}

#[test]
fn objects_of_an_obj_are_paid_for_with_what_becomes_of_them() {
    let _turn = turn();
    let objects: String = (0..30_000)
        .map(|i| format!("o {i}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\n"))
        .collect();
    scene(
        SceneFormat::Obj,
        objects.as_bytes(),
        &["the object \"", "MiB"],
    );
}

#[test]
fn polygons_of_many_corners_are_bounded() {
    let _turn = turn();
    // A comb of 4,000 teeth, named a thousand times. Its first corner does not see it whole.
    let corners: String = (0..4_000)
        .map(|i| format!("v {i} {} 0\n", if i % 2 == 0 { 0 } else { 100 }))
        .collect();
    let face: String = (1..=4_002).map(|i| format!(" {i}")).collect();
    let bomb = comb_of(&corners) + &format!("f{face}\n").repeat(1000);
    let options = LoadOptions {
        max_work: 1 << 24,
        ..LoadOptions::default()
    };
    let error = load_slice(SceneFormat::Obj, bomb.as_bytes(), None, &options).unwrap_err();
    let message = error.to_string();
    assert!(message.contains("max_work"), "{message}");
    // A single one beyond the most is left out.
    let wide: String = (1..=9_000).map(|i| format!(" {}", i % 4_002 + 1)).collect();
    let scene = load_slice(
        SceneFormat::Obj,
        (comb_of(&corners) + &format!("f{wide}\n")).as_bytes(),
        None,
        &options,
    )
    .unwrap();
    assert_eq!(scene.triangle_count(), 0);
}

fn comb_of(corners: &str) -> String {
    format!("v 0 -1 0\n{corners}v 4000 -1 0\n")
}

#[test]
fn a_line_that_is_continued_often_is_copied_once() {
    let _turn = turn();
    let text = "\\\n".repeat(20_000) + "v 0 0 0\n";
    let before = ALLOCATOR.total_allocated();
    load_slice(SceneFormat::Obj, text.as_bytes(), None, &options()).unwrap();
    let taken = ALLOCATOR.total_allocated() - before;
    assert!(taken < 1 << 20, "{taken} bytes for {} of text", text.len());
}

#[test]
fn parts_of_an_obj_are_paid_for_before_they_become_entities() {
    let _turn = turn();
    let bomb = "v 0 0 0\n".to_owned() + &"g\np 1\n".repeat(170_000);
    scene(SceneFormat::Obj, bomb.as_bytes(), &["MiB"]);
    let few = "v 0 0 0\n".to_owned() + &"g\np 1\n".repeat(60_000);
    scene(SceneFormat::Obj, few.as_bytes(), &["the object \"", "MiB"]);
}

#[test]
fn names_of_material_libraries_are_looked_up_once_and_are_work() {
    let _turn = turn();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    let options = LoadOptions {
        max_work: 1 << 16,
        ..options()
    };
    let corner = "v 0 0 0\np 1\n";
    let same = format!("mtllib{}\nmtllib a\n{corner}", " a".repeat(1000));
    std::fs::write(&path, same).unwrap();
    let loaded = load_with_attachments(&path, &options, &[]).unwrap();
    assert_eq!(loaded.left_out.to_string(), "1 material (missing)");
    let names: String = (0..1000).map(|i| format!("mtllib {i}.mtl\n")).collect();
    std::fs::write(&path, names + corner).unwrap();
    let message = load(&path, &options).unwrap_err().to_string();
    assert!(message.contains("the material library"), "{message}");
    assert!(message.contains("max_work"), "{message}");
}

#[test]
fn a_folder_is_listed_once_however_many_names_are_not_in_it() {
    let _turn = turn();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    for i in 0..500 {
        std::fs::write(folder.path().join(format!("{i}.txt")), "").unwrap();
    }
    let materials: String = (0..500)
        .map(|i| format!("newmtl {i}\nmap_Kd {i}.png\n"))
        .collect();
    std::fs::write(folder.path().join("Look.mtl"), materials).unwrap();
    let faces: String = (0..500).map(|i| format!("usemtl {i}\nf 1 2 3\n")).collect();
    let shape = "mtllib look.MTL\nv 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned();
    std::fs::write(&path, shape + &faces).unwrap();
    let load = |max_work| {
        let options = LoadOptions {
            max_work,
            ..options()
        };
        load_with_attachments(&path, &options, &[])
    };
    let loaded = load(1 << 21).unwrap();
    assert_eq!(loaded.left_out.to_string(), "500 images (missing)");
    // The names that are listed are work.
    let message = load(16 << 10).unwrap_err().to_string();
    assert!(message.contains("max_work"), "{message}");
}

#[test]
fn triangles_of_an_stl_are_paid_for() {
    let _turn = turn();
    let bomb = common::stl_binary(b"bomb", 300_000);
    scene(SceneFormat::Stl, &bomb, &["MiB"]);
}

#[test]
fn elements_of_a_ply_are_paid_for_before_they_are_read() {
    let _turn = turn();
    let header = "ply\nformat ascii 1.0\nelement vertex 1000000\nproperty float x\nend_header\n";
    let bomb = header.to_owned() + &"0\n".repeat(1_000_000);
    scene(
        SceneFormat::Ply,
        bomb.as_bytes(),
        &["1000000 elements \"vertex\"", "MiB"],
    );
}

#[test]
fn lists_of_a_ply_are_paid_for_as_what_they_become() {
    let _turn = turn();
    let length: u32 = 20 << 20;
    for element in ["face", "tristrips"] {
        let header = format!(
            "ply\nformat binary_little_endian 1.0\nelement {element} 1\nproperty list uint uchar vertex_indices\nend_header\n"
        );
        let mut bomb = header.into_bytes();
        bomb.extend(length.to_le_bytes());
        bomb.resize(bomb.len() + length as usize, 0);
        scene(SceneFormat::Ply, &bomb, &[element, "MiB"]);
    }
}

#[test]
fn texts_are_paid_for_before_they_are_copied() {
    let _turn = turn();
    let header = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n";
    let ply = header.to_owned() + &"0\n".repeat(MEMORY / 2 + 1);
    // A name that is not UTF-8.
    let obj = [b"o \xff\n".as_slice(), &vec![b'\n'; MEMORY / 2]].concat();
    let stl = [b"solid \xff\n".as_slice(), &vec![b'\n'; MEMORY / 2]].concat();
    for (format, bomb) in [
        (SceneFormat::Ply, ply.into_bytes()),
        (SceneFormat::Obj, obj),
        (SceneFormat::Stl, stl),
    ] {
        let before = ALLOCATOR.total_allocated();
        scene(format, &bomb, &["MiB"]);
        let taken = ALLOCATOR.total_allocated() - before;
        assert!(taken < 1 << 20, "{format:?}: {taken} bytes");
    }
}
