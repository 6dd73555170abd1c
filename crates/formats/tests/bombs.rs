//! Small files that would become huge: each is refused with the part named, within its budget of memory, which an allocator measures, and within
//! its budget of work. The tests of this program take turns, since they share the allocator.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "bombs/shapes.rs"]
mod shapes;

mod common;

use std::alloc::System;
use std::io::{Cursor, Write};
use std::sync::{Mutex, MutexGuard, PoisonError};

use antumbra_formats::{
    LoadOptions, RasterFormat, RasterOptions, SceneFormat, load_raster_slice_with, load_slice,
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
fn channels_times_sparse_indices_are_bounded() {
    let _turn = turn();
    // No channel has as many times as values, so that none of them is read further.
    let (channels, replaced) = (100, 1 << 20);
    let channel = r#"{"sampler":0,"target":{"node":0,"path":"rotation"}}"#;
    let channels = vec![channel; channels].join(",");
    let length = 4 * replaced;
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{length}}}],"bufferViews":[{{"buffer":0,"byteLength":{length}}}],
            "accessors":[{{"componentType":5126,"count":1,"type":"SCALAR"}},
                {{"componentType":5121,"normalized":true,"count":{replaced},"type":"VEC4","sparse":{{"count":{replaced},
                    "indices":{{"bufferView":0,"componentType":5125}},"values":{{"bufferView":0}}}}}}],
            "animations":[{{"channels":[{channels}],"samplers":[{{"input":0,"output":1}}]}}],"nodes":[{{}}]}}"#
    );
    let indices: Vec<u8> = (0..replaced as u32).flat_map(u32::to_le_bytes).collect();
    let options = LoadOptions {
        max_work: 1 << 24,
        ..LoadOptions::default()
    };
    let bomb = glb(&json, &indices);
    let error = load_slice(SceneFormat::Gltf, &bomb, None, &options).unwrap_err();
    let message = error.to_string();
    assert!(message.contains("animation 0"), "{message}");
    assert!(message.contains("max_work"), "{message}");
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

#[test]
fn surfaces_of_a_cityjson_with_many_corners_are_bounded() {
    let _turn = turn();
    let options = LoadOptions {
        max_work: 1 << 20,
        ..LoadOptions::default()
    };
    for is_template in [false, true] {
        let load = |surfaces| {
            let file = combs(surfaces, is_template);
            load_slice(SceneFormat::CityJson, file.as_bytes(), None, &options)
        };
        // A comb of 2,002 corners takes a sixteenth of the work.
        assert_ne!(load(8).unwrap().triangle_count(), 0);
        let message = load(20).unwrap_err().to_string();
        let part = match is_template {
            false => "the objects of line 1",
            true => "template 0",
        };
        assert!(message.contains(part), "{message}");
        assert!(message.contains("max_work"), "{message}");
    }
}

/// A CityJSON of one object, with the same comb for each of its surfaces; these are the object's own, or those of a template that it places.
fn combs(surfaces: usize, is_template: bool) -> String {
    let teeth = (0..2_000).map(|i| format!("[{i},0,{}]", i % 2 * 100));
    let ends = ["[2000,0,-1]", "[0,0,-1]"].map(str::to_owned);
    let corners = teeth.chain(ends).collect::<Vec<_>>().join(",");
    let ring = (0..2_002).map(|i| i.to_string()).collect::<Vec<_>>();
    let surface = format!("[[{}]]", ring.join(","));
    let boundaries = vec![surface; surfaces].join(",");
    let shape = format!(r#"{{"type":"MultiSurface","lod":"1","boundaries":[{boundaries}]}}"#);
    let own = r#"{"type":"GeometryInstance","template":0,"boundaries":[0]}"#;
    let (templates, geometry) = match is_template {
        false => (String::new(), shape),
        true => (
            format!(
                r#""geometry-templates":{{"templates":[{shape}],"vertices-templates":[{corners}]}},"#
            ),
            own.to_owned(),
        ),
    };
    format!(
        r#"{{"type":"CityJSON","version":"2.0","transform":{{"scale":[1,1,1],"translate":[0,0,0]}},{templates}"CityObjects":{{"a":{{"type":"Building","geometry":[{geometry}]}}}},"vertices":[{corners}]}}"#
    )
}
