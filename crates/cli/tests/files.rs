//! Scene files on the command line: what they show, and what the program says of what it left out.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::collections::BTreeMap;
use std::path::Path;

use common::{Folder, antumbra, refuses, stderr, succeeds};

/// An orthographic view of 8 by 10.667 metres from +Z.
const FRONT: &str = r#"{"projection":{"orthographic":{"height":8.0,"near":0.0,"far":1000.0}},"poses":[{"eye":[0,0,50],"target":[0,0,0]}]}"#;

/// A view of the box from -1 to 1 that shows three of its faces.
const ASIDE: &str = r#"{"projection":{"perspective":{"fov_y_degrees":40,"near":0.1}},"poses":[{"eye":[4,3,5],"target":[0,0,0]}]}"#;

/// A folder with the two views.
fn views() -> Folder {
    let folder = Folder::new();
    folder.write("front.json", FRONT);
    folder.write("aside.json", ASIDE);
    folder
}

/// The number of pixels of each colour of a picture of a scene, without the background.
fn drawn(folder: &Folder, scene: &str, path: &str) -> BTreeMap<[u8; 3], usize> {
    let picture = folder.at("picture.png");
    let view = folder.at(path);
    let arguments = ["render", scene, "--path", &view];
    let more = ["--size", "320x240", "--quiet", "-o", &picture];
    succeeds(&[&arguments[..], &more[..]].concat());
    colours(Path::new(&picture))
}

fn colours(picture: &Path) -> BTreeMap<[u8; 3], usize> {
    let picture = image::open(picture).unwrap().into_rgb8();
    let background = picture.get_pixel(0, 0).0;
    let mut colours = BTreeMap::new();
    for pixel in picture.pixels().filter(|pixel| pixel.0 != background) {
        *colours.entry(pixel.0).or_insert(0) += 1;
    }
    colours
}

fn share(colours: &BTreeMap<[u8; 3], usize>) -> f64 {
    100.0 * colours.values().sum::<usize>() as f64 / (320.0 * 240.0)
}

/// The corners of a box from -1 to 1, and its faces with four corners.
fn box_obj() -> String {
    let corners: String = (0..8)
        .map(|i| {
            let at = |bit: i32| if i & bit == 0 { -1 } else { 1 };
            format!("v {} {} {}\n", at(1), at(2), at(4))
        })
        .collect();
    corners + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"
}

#[test]
fn a_box_without_normals_has_three_shades() {
    let folder = views();
    let scene = folder.write("box.obj", box_obj());
    let colours = drawn(&folder, &scene, "aside.json");
    let faces = colours.values().filter(|pixels| **pixels > 1_000);
    assert_eq!(faces.count(), 3, "{colours:?}");
}

#[test]
fn a_concave_polygon_covers_what_it_encloses() {
    let folder = views();
    let u = "v -3 -3 0\nv 3 -3 0\nv 3 3 0\nv 1 3 0\nv 1 -1 0\nv -1 -1 0\nv -1 3 0\nv -3 3 0\nf 1 2 3 4 5 6 7 8\n";
    let colours = drawn(&folder, &folder.write("u.obj", u), "front.json");
    // 28 of 85.33 square metres.
    assert!((share(&colours) - 32.81).abs() < 0.1, "{}", share(&colours));
}

#[test]
fn what_glows_is_seen_in_the_dark() {
    let folder = views();
    folder.write("m.mtl", "newmtl m\nKd 0 0 0\nKe 0 1 0\n");
    let square = "mtllib m.mtl\nusemtl m\nv -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nf 1 2 3 4\n";
    let colours = drawn(&folder, &folder.write("glow.obj", square), "front.json");
    assert!((share(&colours) - 42.19).abs() < 0.1, "{}", share(&colours));
    // The rest is the shine of the lamp.
    let green = colours.keys().all(|[r, g, b]| *g == 255 && r.max(b) < &80);
    assert!(green, "{colours:?}");
}

/// A square whose image is missing.
fn untextured(folder: &Folder) -> String {
    folder.write("m.mtl", "newmtl m\nmap_Kd gone.png\nmap_Bump gone.png\n");
    let square = "mtllib m.mtl\nusemtl m\nv -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nvt 0 0\nf 1/1 2/1 3/1 4/1\n";
    folder.write("a.obj", square)
}

#[test]
fn what_is_left_out_is_said_in_a_line_named_or_refused() {
    let folder = Folder::new();
    let scene = untextured(&folder);
    let picture = folder.write("a.png", "");
    let render = |more: &[&str]| {
        let first = ["render", &scene, "--size", "64x48", "-o", &picture];
        antumbra(&[&first[..], more].concat())
    };
    let said = stderr(&render(&[]));
    assert!(
        said.contains("left out: 1 image (missing), 1 shading detail"),
        "{said}"
    );
    assert!(said.contains("--verbose"), "{said}");
    assert_eq!(said.matches("a.obj").count(), 1, "{said}");
    let named = stderr(&render(&["--verbose"]));
    assert!(named.contains("gone.png"), "{named}");
    assert_eq!(stderr(&render(&["--quiet"])), "");
    let without = render(&["--no-images"]);
    let said = stderr(&without);
    assert!(
        without.status.success() && !said.contains("1 image"),
        "{said}"
    );
    let strict = render(&["--strict"]);
    assert_eq!(strict.status.code(), Some(1));
    let said = stderr(&strict);
    assert!(
        said.contains("1 image (missing)") && said.contains("strict"),
        "{said}"
    );
    assert_eq!(said.matches("a.obj").count(), 1, "{said}");
    assert!(
        render(&["--strict", "--no-images"]).status.success(),
        "shading alone is lost"
    );
}

#[test]
fn a_report_keeps_what_was_left_out() {
    let folder = Folder::new();
    folder.write(
        "m.mtl",
        "newmtl m\nmap_Kd gone.png\nnewmtl n\nmap_Kd lost.png\n",
    );
    let squares = "mtllib m.mtl\nusemtl m\nv -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nf 1 2 3 4\nusemtl n\nf 4 3 2 1\n";
    let scene = folder.write("a.obj", squares);
    let out = folder.path("out");
    let shown = succeeds(&[
        "compare",
        &scene,
        "--strategies",
        "frustum",
        "--frames",
        "2",
        "--size",
        "64x48",
        "--out",
        out.to_str().unwrap(),
    ]);
    assert!(
        shown.contains("left out of its file: 2 images (missing)"),
        "{shown}"
    );
    let report = std::fs::read_to_string(out.join("report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let left_out = &report["scene"]["left_out"];
    assert_eq!(left_out[0]["part"], "images");
    assert_eq!(left_out[0]["count"], 2);
    assert_eq!(left_out[0]["reason"], "missing");
}

#[test]
fn arguments_of_scene_files_are_refused_where_none_is_loaded() {
    let folder = Folder::new();
    let raster = folder.write(
        "dem.asc",
        "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n0 1\n1 5\n",
    );
    let picture = folder.write("a.png", "");
    let scene = folder.write("a.glb", "");
    for argument in ["--strict", "--no-images", "--verbose"] {
        let words = ["--strict, --no-images and --verbose are for scene files"];
        for shown in [raster.as_str(), "grid:2", "subsurface", "terrain"] {
            refuses(&["render", shown, argument, "-o", &picture], 2, &words);
        }
        for input in [raster.as_str(), "terrain", "subsurface"] {
            refuses(&["prepare", input, argument, "-o", &scene], 2, &words);
        }
        let horizon = [
            "prepare",
            &raster,
            argument,
            "--as",
            "subsurface",
            "-o",
            &scene,
        ];
        refuses(&horizon, 2, &words);
    }
    // What the load may take is for all files.
    let memory = [
        "prepare", &raster, "--memory", "1GiB", "--quiet", "-o", &scene,
    ];
    succeeds(&memory);
}

#[test]
fn a_file_without_anything_to_draw_is_an_error_that_says_why() {
    let folder = Folder::new();
    let curves = folder.write("curves.obj", "v 0 0 0\nv 1 0 0\ncurv 0 1 1 2\n");
    let picture = folder.path("a.png");
    let picture = picture.to_str().unwrap();
    let out = folder.path("out");
    let out = out.to_str().unwrap();
    let words = ["nothing to draw", "free-form curves", "curves.obj"];
    refuses(&["render", &curves, "-o", picture], 1, &words);
    refuses(&["compare", &curves, "--out", out], 1, &words);
    refuses(
        &[
            "prepare",
            &curves,
            "-o",
            folder.path("a.glb").to_str().unwrap(),
        ],
        1,
        &words,
    );
}
