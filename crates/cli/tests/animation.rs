//! `--time`, `--animate` and `--animation`: what moves in a scene file.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::path::Path;

use antumbra::measure::report::Report;
use common::{antumbra, refuses, stderr, succeeds};
use image::RgbImage;

/// A triangle of 1 m that moves 4 m along x within 2 s, with a camera before it that moves along; the clip "turn" turns it by half.
fn scene(folder: &Path) -> String {
    let numbers: [f32; 29] = [
        -0.5, -0.5, 0.0, 0.5, -0.5, 0.0, 0.0, 0.5, 0.0, // positions
        0.0, 2.0, // times
        0.0, 0.0, 0.0, 4.0, 0.0, 0.0, // translations
        0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, // rotations
        0.0, 0.0, 3.0, 0.0,
    ];
    let bytes: Vec<u8> = numbers
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    std::fs::write(folder.join("scene.bin"), bytes).unwrap();
    let json = r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"scene.bin","byteLength":116}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8},{"buffer":0,"byteOffset":44,"byteLength":24},{"buffer":0,"byteOffset":68,"byteLength":32}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR"},
{"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"},{"bufferView":3,"componentType":5126,"count":2,"type":"VEC4"}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"nodes":[{"mesh":0,"children":[1]},{"camera":0,"translation":[0,0,3]},{"mesh":0,"translation":[0,-1,0]}],
"animations":[{"name":"go","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],"samplers":[{"input":1,"output":2}]},
{"name":"turn","channels":[{"sampler":0,"target":{"node":0,"path":"rotation"}}],"samplers":[{"input":1,"output":3}]}]}"#;
    let file = folder.join("scene.gltf");
    std::fs::write(&file, json).unwrap();
    file.to_str().unwrap().to_owned()
}

/// What `render` draws with these further arguments.
fn drawn(folder: &Path, scene: &str, more: &[&str]) -> RgbImage {
    let file = folder.join("image.png");
    let image = file.to_str().unwrap();
    let arguments = [&["render", scene, "--size", "64x48", "-o", image], more].concat();
    succeeds(&arguments);
    image::open(file).unwrap().into_rgb8()
}

#[test]
fn a_time_is_drawn_and_a_clip_begins_again() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let at = |more: &[&str]| drawn(folder.path(), &scene, more);
    let (first, later) = (at(&["--time", "0"]), at(&["--time", "1.5"]));
    assert!(first != later);
    assert!(later == at(&["--time", "3.5"]));
    let still = at(&["--time", "1.5", "--pose", "10"]);
    assert!(still == at(&["--time", "0.5", "--animate=10", "--pose", "10"]));
    assert!(first == at(&["--animation", "0"]));
    let turned = at(&["--time", "1.5", "--animation", "turn"]);
    assert!(turned == at(&["--time", "1.5", "--animation", "1"]));
    assert!(turned != later);
}

#[test]
fn a_camera_of_the_scene_is_carried_along() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    // The other triangle stays behind, and the camera sees it pass by.
    let at = |pose: &str| {
        let more = ["--path", "camera", "--animate=4", "--pose", pose];
        drawn(folder.path(), &scene, &more)
    };
    let [first, later, again] = ["0", "4", "9"].map(at);
    assert!(first != later);
    // The triangle that moves along is in the middle of both.
    assert_eq!(first.get_pixel(32, 24), later.get_pixel(32, 24));
    assert_ne!(first.get_pixel(32, 24), first.get_pixel(0, 0));
    assert!(again != later);
}

#[test]
fn a_comparison_says_what_plays() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let out = folder.path().join("out");
    let printed = succeeds(&[
        "compare",
        &scene,
        "--animate",
        "--frames",
        "6",
        "--size",
        "64x48",
        "--strategies",
        "frustum,depth-pyramid",
        "--out",
        out.to_str().unwrap(),
    ]);
    let words = "animation go from 0 s on, 30 frames a second of it, again after 2 s";
    assert!(printed.contains(words), "{printed}");
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains(words));
    let report = Report::load(out.join("report.json")).unwrap();
    let motion = report.scene.motion.unwrap();
    assert_eq!(motion.frames_per_second, Some(30.0));
    assert!(report.scene.left_out.is_empty());
}

#[test]
fn what_cannot_play_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let image = folder.path().join("image.png");
    let render = [
        "render",
        &scene,
        "--size",
        "64x48",
        "-o",
        image.to_str().unwrap(),
    ];
    let with = |more: &[&'static str]| [&render[..], more].concat();
    let words = ["no such animation", "0 \"go\", 1 \"turn\""];
    refuses(&with(&["--animation", "stop"]), 2, &words);
    refuses(
        &with(&["--time", "-1"]),
        2,
        &["seconds from 0 to 1000000000"],
    );
    refuses(
        &with(&["--animate=0"]),
        2,
        &["poses a second from 0.001 to 1000000"],
    );
    let built_in = [
        "render",
        "grid:2",
        "--time",
        "1",
        "-o",
        image.to_str().unwrap(),
    ];
    refuses(&built_in, 2, &["no animation that can be played"]);
    let at_rest = antumbra(&render);
    assert!(at_rest.status.success());
    let said = stderr(&at_rest);
    assert!(
        said.contains("shown at rest; it has 2 animations"),
        "{said}"
    );
}
