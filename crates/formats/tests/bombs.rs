//! Small files that would become huge: each is refused with the part named, within its budget of memory, which an allocator measures, and within
//! its budget of work. The tests of this program take turns, since they share the allocator.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::alloc::System;
use std::io::{Cursor, Write};
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use antumbra_formats::{
    LoadOptions, RasterFormat, RasterOptions, SceneFormat, load, load_raster_slice_with,
    load_slice, load_with_attachments,
};
use cap::Cap;
use common::{floats, glb};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

static TURN: Mutex<()> = Mutex::new(());

/// The budget of memory.
const MEMORY: usize = 64 << 20;

fn options() -> LoadOptions {
    LoadOptions {
        max_memory: MEMORY as u64,
        ..LoadOptions::default()
    }
}

/// The turn of a test, from before it makes its input: what one test allocates counts against the limit of another.
fn turn() -> MutexGuard<'static, ()> {
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs what must be refused; its message. Beyond the budget no more than what is read, and what is taken in one step, is allocated.
fn refused<T>(read: impl FnOnce() -> Result<T, String>, words: &[&str]) {
    let before = ALLOCATOR.allocated();
    ALLOCATOR.set_limit(before + 2 * MEMORY).unwrap();
    let read = read();
    ALLOCATOR.set_limit(usize::MAX).unwrap();
    let message = read.err().expect("it was not refused");
    assert!(message.len() < 1000, "{} bytes", message.len());
    for word in words {
        assert!(message.contains(word), "'{word}' is not in: {message}");
    }
}

fn scene(format: SceneFormat, bytes: &[u8], words: &[&str]) {
    let load = || load_slice(format, bytes, None, &options());
    refused(|| load().map_err(|error| error.to_string()), words);
}

fn raster(format: RasterFormat, bytes: &[u8], words: &[&str]) {
    let load = || {
        let options = RasterOptions {
            max_memory: MEMORY as u64,
            ..RasterOptions::default()
        };
        load_raster_slice_with(format, bytes, &options)
    };
    refused(|| load().map_err(|error| error.to_string()), words);
}

fn npy(kind: &str, shape: &str, data: usize) -> Vec<u8> {
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}\n");
    let mut bytes = b"\x93NUMPY\x02\x00".to_vec();
    bytes.extend((header.len() as u32).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.resize(bytes.len() + data, 0);
    bytes
}

fn npz(arrays: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays {
        let options = SimpleFileOptions::default();
        archive.start_file(format!("{name}.npy"), options).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn arrays_of_an_npz_share_one_budget() {
    let _turn = turn();
    let side = 2048;
    let arrays = ["a", "b", "c"].map(|name| (name, npy("|u1", "(4194304,)", side * side)));
    raster(RasterFormat::Npz, &npz(&arrays), &["array `b`", "MiB"]);
    let large = npz(&[("z", npy("|u1", "(8192, 4096)", 8192 * 4096))]);
    raster(RasterFormat::Npz, &large, &["array `z`", "max_memory"]);
}

#[test]
fn entries_of_an_npz_that_overlap_are_refused() {
    let _turn = turn();
    let honest = npz(&[("a", npy("|u1", "(1024, 1024)", 1 << 20))]);
    let end = honest.len() - 22;
    let number = |at: usize| u32::from_le_bytes(honest[at..at + 4].try_into().unwrap());
    let (length, start) = (number(end + 12) as usize, number(end + 16) as usize);
    let entry = &honest[start..start + length];
    let mut bomb = honest[..start].to_vec();
    for letter in b'a'..=b'y' {
        let mut entry = entry.to_vec();
        entry[46] = letter;
        bomb.extend(entry);
    }
    let mut last = honest[end..].to_vec();
    last[8..10].copy_from_slice(&25_u16.to_le_bytes());
    last[10..12].copy_from_slice(&25_u16.to_le_bytes());
    last[12..16].copy_from_slice(&(25 * length as u32).to_le_bytes());
    bomb.extend(last);
    raster(RasterFormat::Npz, &bomb, &["overlap"]);
}

#[test]
fn headers_of_an_npz_are_quoted_in_short() {
    let _turn = turn();
    let shape = format!("({})", "1,".repeat(1 << 20));
    raster(
        RasterFormat::Npz,
        &npz(&[("z", npy("|u1", &shape, 7))]),
        &["array `z`"],
    );
    let kind = "x".repeat(1 << 20);
    raster(
        RasterFormat::Npz,
        &npz(&[("z", npy(&kind, "(2, 2)", 4))]),
        &["array `z`"],
    );
    let word = format!("ncols {}", "y".repeat(1 << 20));
    raster(RasterFormat::Esri, word.as_bytes(), &["ncols"]);
}

/// A TIFF with one strip of this many bytes for an image of bytes this large.
fn tiff(side: u32, strip: u32) -> Vec<u8> {
    tiff_with(side, strip, 1)
}

/// The same with a directory that declares so many places of strips.
fn tiff_with(side: u32, strip: u32, places: u32) -> Vec<u8> {
    let tags: [(u16, u16, u32); 8] = [
        (256, 4, side),
        (257, 4, side),
        (258, 3, 8),
        (259, 3, 1),
        (262, 3, 1),
        (273, 4, 8),
        (278, 4, side),
        (279, 4, strip),
    ];
    let mut bytes = b"II*\0".to_vec();
    bytes.extend((8 + strip).to_le_bytes());
    bytes.resize(8 + strip as usize, 0);
    bytes.extend((tags.len() as u16).to_le_bytes());
    for (tag, kind, value) in tags {
        bytes.extend(tag.to_le_bytes());
        bytes.extend(kind.to_le_bytes());
        let count = if tag == 273 { places } else { 1 };
        bytes.extend(count.to_le_bytes());
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([0; 4]);
    bytes
}

#[test]
fn posts_of_a_geotiff_are_paid_for_before_they_are_decoded() {
    let _turn = turn();
    let bomb = tiff(32_768, 1 << 18);
    raster(
        RasterFormat::GeoTiff,
        &bomb,
        &["32768 x 32768 posts", "GiB"],
    );
}

#[test]
fn the_directory_of_a_geotiff_is_paid_for_before_it_is_read() {
    let _turn = turn();
    let bomb = tiff_with(2, 64, 6_000_000);
    raster(
        RasterFormat::GeoTiff,
        &bomb,
        &["its tag 273 of 6000000 values", "MiB"],
    );
}

/// A glTF whose mesh 0 is a point, with these further members.
fn point(primitives: usize, name: &str, nodes: &str) -> Vec<u8> {
    let primitive = r#"{"attributes":{"POSITION":0},"mode":0}"#;
    let primitives = vec![primitive; primitives].join(",");
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":12}}],"bufferViews":[{{"buffer":0,"byteLength":12}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":1,"type":"VEC3"}}],
            "meshes":[{{"name":"{name}","primitives":[{primitives}]}}],"nodes":[{nodes}]}}"#
    );
    glb(&json, &floats(&[0.0; 3]))
}

#[test]
fn names_of_a_gltf_that_are_copied_are_paid_for() {
    let _turn = turn();
    let name = "n".repeat(1 << 20);
    let each_part = point(500, &name, r#"{"mesh":0}"#);
    scene(
        SceneFormat::Gltf,
        &each_part,
        &["mesh 0 \"nnn", "primitive", "MiB"],
    );
    let nodes = vec![r#"{"mesh":0}"#; 500].join(",");
    let each_node = point(2, &name, &nodes);
    scene(SceneFormat::Gltf, &each_node, &["node", "MiB"]);
}

#[test]
fn levels_times_primitives_are_bounded() {
    let _turn = turn();
    // Each primitive of node 0 would have a list of all levels.
    let levels = vec!["1"; 40_000].join(",");
    let nodes =
        format!(r#"{{"mesh":0,"extensions":{{"MSFT_lod":{{"ids":[{levels}]}}}}}},{{"mesh":0}}"#);
    let bomb = point(2_000, "levels", &nodes);
    scene(SceneFormat::Gltf, &bomb, &["levels"]);
}

#[test]
fn morph_targets_times_vertices_are_bounded() {
    let _turn = turn();
    let (targets, vertices) = (2_000, 100_000);
    let target = vec![r#"{"POSITION":0}"#; targets].join(",");
    let weights = vec!["1"; targets].join(",");
    let length = vertices * 12;
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{length}}}],"bufferViews":[{{"buffer":0,"byteLength":{length}}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":{vertices},"type":"VEC3"}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":0,"targets":[{target}]}}],"weights":[{weights}]}}],
            "nodes":[{{"mesh":0}}]}}"#
    );
    let bomb = glb(&json, &vec![0; length]);
    let options = LoadOptions {
        max_work: 1 << 24,
        ..LoadOptions::default()
    };
    let error = load_slice(SceneFormat::Gltf, &bomb, None, &options).unwrap_err();
    let message = error.to_string();
    assert!(message.contains("mesh 0, primitive 0"), "{message}");
    assert!(message.contains("max_work"), "{message}");
}

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
fn objects_of_a_cityjson_are_paid_for() {
    let _turn = turn();
    let objects: Vec<String> = (0..60_000)
        .map(|i| format!(r#""{i}":{{"type":"Building"}}"#))
        .collect();
    let bomb = format!(
        r#"{{"type":"CityJSON","version":"2.0","transform":{{"scale":[1,1,1],"translate":[0,0,0]}},"CityObjects":{{{}}},"vertices":[]}}"#,
        objects.join(",")
    );
    scene(SceneFormat::CityJson, bomb.as_bytes(), &["line 1", "MiB"]);
}
