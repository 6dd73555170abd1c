//! Small files that would become huge: each is refused with the part named, within its budget of memory, which an allocator measures. The
//! tests of this program take turns, since they share the allocator.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "read_support/roff.rs"]
#[allow(dead_code, reason = "each test program uses some of it")]
mod roff;

use std::alloc::System;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use antumbra_scene::{Geometry, Scene};
use antumbra_subsurface::read::{ReadOptions, surfaces, surfaces_from_bytes};
use antumbra_subsurface::{
    Axis, PrepareOptions, Slice, SliceOptions, Surface, SurfaceKind, VolumeLayout, prepare_surface,
};
use cap::Cap;
use glam::DVec3;
use roff::{Roff, Way};

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

static TURN: Mutex<()> = Mutex::new(());

/// The budget of memory.
const MEMORY: usize = 64 << 20;

/// The turn of a test, from before it makes its input: what one test allocates counts against the limit of another.
fn turn() -> MutexGuard<'static, ()> {
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

fn refused(name: &str, bytes: &[u8], words: &[&str]) {
    let options = ReadOptions {
        max_memory: Some(MEMORY as u64),
        ..ReadOptions::default()
    };
    let before = ALLOCATOR.allocated();
    ALLOCATOR.set_limit(before + 2 * MEMORY).unwrap();
    let read = surfaces_from_bytes(Path::new(name), bytes, &options, &mut |_, _| ());
    ALLOCATOR.set_limit(usize::MAX).unwrap();
    let message = read.unwrap_err().to_string();
    assert!(message.len() < 1000, "{} bytes", message.len());
    for word in words {
        assert!(message.contains(word), "'{word}' is not in: {message}");
    }
}

#[test]
fn layers_of_a_roff_grid_are_paid_for_before_they_are_made() {
    let _turn = turn();
    let layers = 60_000;
    let mut file = Roff::new(Way::Little, "grid");
    file.dimensions([1, 1, layers]);
    file.word("tag").word("cornerLines");
    file.array("float", "data", &[0.0; 24]).word("endtag");
    let heights = vec![0.0; 4 * (layers as usize + 1)];
    file.word("tag").word("zvalues");
    file.array("float", "data", &heights).word("endtag");
    file.word("tag").word("eof").word("endtag");
    refused(
        "a.roff",
        &file.bytes,
        &["horizons of its 60000 layers", "MiB"],
    );
}

#[test]
fn nodes_of_a_surface_are_paid_for_with_what_becomes_of_them() {
    let _turn = turn();
    let (columns, rows) = (1000, 1000);
    let mut text =
        format!("-996 {rows} 1 1\n0 {columns} 0 {rows}\n{columns} 0 0 0\n0 0 0 0 0 0 0\n");
    text += &"0\n".repeat(columns * rows);
    refused("a.irap", text.as_bytes(), &["1000 x 1000 nodes", "MiB"]);
    let head = format!("ncols {columns}\nnrows {rows}\nxllcorner 0\nyllcorner 0\ncellsize 1\n");
    let text = head + &"0\n".repeat(columns * rows);
    refused("a.asc", text.as_bytes(), &["1000 x 1000", "MiB"]);
}

#[test]
fn nodes_of_a_text_are_paid_for_before_they_are_read() {
    let _turn = turn();
    // Read, they would take more than twice the budget.
    let (columns, rows) = (4000, 3000);
    let mut text =
        format!("-996 {rows} 1 1\n0 {columns} 0 {rows}\n{columns} 0 0 0\n0 0 0 0 0 0 0\n");
    text += &"0\n".repeat(columns * rows);
    refused("a.irap", text.as_bytes(), &["4000 x 3000 nodes", "GiB"]);
}

#[test]
fn a_file_larger_than_the_budget_is_not_read() {
    let _turn = turn();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.irap");
    let file = std::fs::File::create(&path).unwrap();
    // It has holes, and takes no disk.
    file.set_len(1 << 30).unwrap();
    let options = ReadOptions {
        max_memory: Some(MEMORY as u64),
        ..ReadOptions::default()
    };
    let before = ALLOCATOR.allocated();
    ALLOCATOR.set_limit(before + MEMORY).unwrap();
    let read = surfaces(&path, &options, &mut |_, _| ());
    ALLOCATOR.set_limit(usize::MAX).unwrap();
    let message = read.unwrap_err().to_string();
    assert!(
        message.contains("with the file it takes about 1.0 GiB"),
        "{message}"
    );
}

#[test]
fn vertices_picks_and_faults_are_paid_for() {
    let _turn = turn();
    let mut gocad = "GOCAD TSurf 1\n".to_owned();
    for i in 1..150_000 {
        gocad += &format!("VRTX {i} 0 0 0\n");
    }
    refused(
        "a.ts",
        gocad.as_bytes(),
        &["the vertices up to line", "MiB"],
    );
    let objects = "GOCAD TSurf 1\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";
    refused("a.ts", objects.repeat(20_000).as_bytes(), &["MiB"]);
    let triangles = "GOCAD TSurf 1\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\n".to_owned();
    let triangles = triangles + &"TRGL 1 2 3\n".repeat(300_000);
    refused(
        "a.ts",
        triangles.as_bytes(),
        &["the triangles up to line", "MiB"],
    );
    let picks = "x,y,z\n".to_owned() + &"1,2,3\n".repeat(200_000);
    refused("a.csv", picks.as_bytes(), &["the picks", "MiB"]);
    let lists = vec!["[]"; 3_000_000].join(",");
    let faults = format!(
        r#"{{"features":[{{"properties":{{"FaultID":"a"}},"geometry":{{"coordinates":[{lists}]}}}}]}}"#
    );
    refused("a.json", faults.as_bytes(), &["its text", "MiB"]);
}

#[test]
fn what_a_file_says_is_quoted_in_short() {
    let _turn = turn();
    let long = "\u{1b}[31m".to_owned() + &"w".repeat(1 << 20);
    for (name, text) in [
        ("a.irap", format!("-996 {long}")),
        ("a.ts", format!("GOCAD {long}\n")),
        ("a.ts", format!("GOCAD TSurf 1\nVRTX {long}\n")),
        ("a.csv", format!("x,y,z\n{long},1,1\n")),
        ("a.json", format!("{{\"features\":\"{long}\"}}")),
        ("a.roff", format!("roff-asc tag {long} {long}")),
    ] {
        let read = surfaces_from_bytes(
            Path::new(name),
            text.as_bytes(),
            &ReadOptions::default(),
            &mut |_, _| (),
        );
        let message = read.unwrap_err().to_string();
        assert!(message.len() < 2000, "{name}: {} bytes", message.len());
        assert!(!message.contains('\u{1b}'), "{name}: {message:?}");
    }
}

/// A volume of tiny bricks.
fn tiny(side: u32, brick: u32) -> VolumeLayout {
    VolumeLayout {
        size: [side, side, 2],
        brick,
        origin: DVec3::ZERO,
        steps: [DVec3::X, DVec3::Y, DVec3::Z],
        range: [0.0, 1.0],
    }
}

#[test]
fn a_volume_of_tiny_bricks_has_few_tiles() {
    let _turn = turn();
    let layout = tiny(4096, 2);
    let mut scene = Scene::new();
    let usual = SliceOptions::default();
    let error = Slice::spawn(&mut scene, None, &layout, Axis::Time, 0, &usual).unwrap_err();
    assert!(error.to_string().contains("1024 x 1024 tiles"), "{error}");
    assert!(scene.is_empty());
    let options = SliceOptions::for_volume(&layout);
    let slice = Slice::spawn(&mut scene, None, &layout, Axis::Time, 0, &options).unwrap();
    assert_eq!(slice.tiles().len(), 64 * 64);
    let wide = tiny(1 << 20, 2);
    let error = Slice::spawn(&mut scene, None, &wide, Axis::Time, 0, &options).unwrap_err();
    assert!(error.to_string().contains("larger bricks"), "{error}");
}

#[test]
fn many_triangles_at_one_vertex_are_no_endless_work() {
    let _turn = turn();
    let spokes = 60_000_u32;
    let angle = |i: u32| f64::from(i) / f64::from(spokes) * std::f64::consts::TAU;
    let rim = (0..spokes).map(|i| [angle(i).cos() as f32, 0.1, angle(i).sin() as f32]);
    let geometry = Geometry {
        positions: [[0.0; 3]].into_iter().chain(rim).collect(),
        indices: (1..spokes).flat_map(|i| [0, i + 1, i]).collect(),
        ..Geometry::default()
    };
    assert!(!geometry.is_collapsible());
    let surface = Surface {
        name: "fan".to_owned(),
        kind: SurfaceKind::Fault,
        origin: DVec3::ZERO,
        geometry,
        plan: Vec::new(),
    };
    let prepared = prepare_surface(&surface, &PrepareOptions::default()).unwrap();
    assert_eq!(prepared.triangles(), spokes as usize - 1);
    assert!(prepared.proxy_triangles() < 10_000);
}
