//! Hostile files through the whole program: what becomes of them on the way to the GPU stays bounded. They need GNU time and some seconds:
//!
//!     cargo test --release -p antumbra-cli --test scale -- --ignored --nocapture --test-threads 1
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::fmt::Write as _;
use std::fs;
use std::io::{Seek as _, SeekFrom, Write as _};
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use antumbra::subsurface::{BrickSource, SubsurfaceError, VolumeLayout, write_volume};
use common::{Folder, PROGRAM, QUIET_MESA};
use glam::DVec3;

/// What a run has taken.
struct Run {
    kib: u64,
    time: Duration,
    code: Option<i32>,
    message: String,
}

/// Runs the program under GNU time.
fn run(arguments: &[&str]) -> Run {
    let begin = Instant::now();
    let output = Command::new("/usr/bin/time")
        .args(["-f", "\npeak %M", PROGRAM])
        .args(arguments)
        .env(QUIET_MESA.0, QUIET_MESA.1)
        .output()
        .expect("GNU time");
    let time = begin.elapsed();
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    let (message, peak) = text.rsplit_once("\npeak ").unwrap();
    let run = Run {
        kib: peak.trim().parse().unwrap(),
        time,
        code: output.status.code(),
        message: message.to_owned(),
    };
    println!(
        "{}: {} MiB, {:.1} s, status {:?}: {}",
        arguments[..2].join(" "),
        run.kib / 1024,
        run.time.as_secs_f64(),
        run.code,
        run.message.trim()
    );
    run
}

const GIB: u64 = 1 << 20;

#[track_caller]
fn refused(run: &Run, words: &[&str]) {
    assert_eq!(run.code, Some(1), "{}", run.message);
    assert!(run.kib < GIB, "{} KiB", run.kib);
    for word in words {
        assert!(
            run.message.contains(word),
            "'{word}' is not in: {}",
            run.message
        );
    }
}

#[track_caller]
fn drawn(run: &Run) {
    assert_eq!(run.code, Some(0), "{}", run.message);
    assert!(run.kib < GIB, "{} KiB", run.kib);
}

fn render<'a>(scene: &'a str, image: &'a str) -> Vec<&'a str> {
    vec!["render", scene, "--size", "64x48", "-o", image]
}

/// An OBJ of so many objects of a triangle each.
fn objects(count: u32) -> String {
    let mut text = String::new();
    for i in 0..count {
        let (x, y) = (i % 300, i / 300);
        writeln!(
            text,
            "o {i}\nv {x} {y} 0\nv {x}.5 {y} 0\nv {x} {y}.5 0\nf -3 -2 -1"
        )
        .unwrap();
    }
    text
}

#[test]
#[ignore = "takes seconds, and GNU time"]
fn a_scene_of_many_small_objects_reaches_the_gpu_in_bounded_memory() {
    let folder = Folder::new();
    // 17 MB of text.
    let scene = folder.write("many.obj", objects(300_000).as_bytes());
    let image = folder.at("a.png");
    drawn(&run(&render(&scene, &image)));
    let asked = [&render(&scene, &image)[..], &["--memory", "512MiB"]].concat();
    refused(&run(&asked), &["the object", "512 MiB"]);
}

/// A volume of one value in bricks of two samples an edge.
struct Tiny(VolumeLayout);

impl BrickSource for Tiny {
    fn layout(&self) -> &VolumeLayout {
        &self.0
    }

    fn read(&self, _: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError> {
        samples.fill(7);
        Ok(())
    }
}

#[test]
#[ignore = "takes seconds, and GNU time"]
fn a_volume_of_tiny_bricks_is_drawn_or_refused() {
    let folder = Folder::new();
    let image = folder.at("a.png");
    for (name, size) in [
        ("drawn.vol", [2048, 2048, 2]),
        ("refused.vol", [1 << 20, 8192, 1]),
    ] {
        let source = Tiny(VolumeLayout {
            size,
            brick: 2,
            origin: DVec3::ZERO,
            steps: [DVec3::X, DVec3::Y, DVec3::Z],
            range: [0.0, 1.0],
        });
        let volume = folder.at(name);
        if name == "drawn.vol" {
            write_volume(Path::new(&volume), "tiny", &source, &mut |_, _| ()).unwrap();
            let asked = [&render("grid:2", &image)[..], &["--volume", &volume]].concat();
            drawn(&run(&asked));
            continue;
        }
        // Sparse: its header, and bricks that were never written.
        let small = Tiny(VolumeLayout {
            size: [2; 3],
            ..source.0
        });
        write_volume(Path::new(&volume), "tiny", &small, &mut |_, _| ()).unwrap();
        let mut file = fs::OpenOptions::new().write(true).open(&volume).unwrap();
        file.seek(SeekFrom::Start(16)).unwrap();
        for side in size {
            file.write_all(&side.to_le_bytes()).unwrap();
        }
        let header = file.metadata().unwrap().len() - 8;
        let length = header + source.0.total_bytes().unwrap();
        file.set_len(length).unwrap();
        drop(file);
        let asked = [&render("grid:2", &image)[..], &["--volume", &volume]].concat();
        refused(&run(&asked), &["tiles", "larger bricks"]);
    }
}

#[test]
#[ignore = "takes seconds, and GNU time"]
fn a_hundred_thousand_equal_triangles_are_drawn() {
    let folder = Folder::new();
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned() + &"f 1 2 3\n".repeat(100_000);
    let scene = folder.write("equal.obj", text.as_bytes());
    drawn(&run(&render(&scene, &folder.at("a.png"))));
    let mut text = "GOCAD TSurf 1\nVRTX 1 0 0 0\nVRTX 2 100 0 0\nVRTX 3 0 100 50\n".to_owned();
    text += &"TRGL 1 2 3\n".repeat(100_000);
    let surface = folder.write("equal.ts", text.as_bytes());
    drawn(&run(&["prepare", &surface, "-o", &folder.at("a.glb")]));
}

#[test]
#[ignore = "takes seconds, and GNU time"]
fn bombs_are_refused_by_the_program_with_the_part_named() {
    let folder = Folder::new();
    let out = folder.at("out.glb");
    // Posts: a strip of 256 KiB for 2^30 of them.
    let tags: [(u16, u16, u32); 8] = [
        (256, 4, 32_768),
        (257, 4, 32_768),
        (258, 3, 8),
        (259, 3, 1),
        (262, 3, 1),
        (273, 4, 8),
        (278, 4, 32_768),
        (279, 4, 1 << 18),
    ];
    let mut tiff = b"II*\0".to_vec();
    tiff.extend((8 + (1_u32 << 18)).to_le_bytes());
    tiff.resize(8 + (1 << 18), 0);
    tiff.extend(8_u16.to_le_bytes());
    for (tag, kind, value) in tags {
        tiff.extend(tag.to_le_bytes());
        tiff.extend(kind.to_le_bytes());
        tiff.extend(1_u32.to_le_bytes());
        tiff.extend(value.to_le_bytes());
    }
    tiff.extend([0; 4]);
    let tiff = folder.write("posts.tif", &tiff);
    for made in ["terrain", "subsurface"] {
        refused(
            &run(&["prepare", &tiff, "--as", made, "-o", &out]),
            &["32768 x 32768 posts"],
        );
    }
    // Names, one megabyte long, of ten thousand primitives.
    let name = "n".repeat(1 << 20);
    let primitives = vec![r#"{"attributes":{"POSITION":0},"mode":0}"#; 40_000].join(",");
    let gltf = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":12,"uri":"data:;base64,AAAAAAAAAAAAAAAA"}}],
            "bufferViews":[{{"buffer":0,"byteLength":12}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":1,"type":"VEC3"}}],
            "meshes":[{{"name":"{name}","primitives":[{primitives}]}}],"nodes":[{{"mesh":0}}]}}"#
    );
    let gltf = folder.write("names.gltf", gltf.as_bytes());
    let mut asked = render(&gltf, &out);
    let image = folder.at("a.png");
    asked[5] = &image;
    asked.extend(["--memory", "512MiB"]);
    refused(&run(&asked), &["mesh 0", "primitive", "512 MiB"]);
    // Layers: three million.
    let mut roff = b"roff-bin\0#ROFF file#\0".to_vec();
    let word = |roff: &mut Vec<u8>, words: &[&str]| {
        for word in words {
            roff.extend(word.as_bytes());
            roff.push(0);
        }
    };
    let layers = 3_000_000_u32;
    word(&mut roff, &["tag", "filedata", "int", "byteswaptest"]);
    roff.extend(1_u32.to_le_bytes());
    word(
        &mut roff,
        &["char", "filetype", "grid", "endtag", "tag", "dimensions"],
    );
    for (key, value) in [("nX", 1), ("nY", 1), ("nZ", layers)] {
        word(&mut roff, &["int", key]);
        roff.extend(value.to_le_bytes());
    }
    word(
        &mut roff,
        &["endtag", "tag", "cornerLines", "array", "float", "data"],
    );
    roff.extend(24_u32.to_le_bytes());
    roff.resize(roff.len() + 24 * 4, 0);
    word(
        &mut roff,
        &["endtag", "tag", "zvalues", "array", "float", "data"],
    );
    let heights = 4 * (layers + 1);
    roff.extend(heights.to_le_bytes());
    roff.resize(roff.len() + 4 * heights as usize, 0);
    word(&mut roff, &["endtag", "tag", "eof", "endtag"]);
    let roff = folder.write("layers.roff", &roff);
    let memory = ["--memory", "2GiB"];
    let asked = [&["prepare", &roff, "-o", &out], &memory[..]].concat();
    refused(&run(&asked), &["3000000 layers"]);
}
