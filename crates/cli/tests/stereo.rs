//! Two eyes from the command line: layouts of images, the report of a comparison, and what is refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::path::Path;

use common::{refuses, succeeds};
use image::RgbImage;

/// The image that `render` writes under a name, of a grid with its first pose; `asked` are further arguments.
fn rendered(folder: &Path, name: &str, asked: &[&str]) {
    let file = folder.join(name);
    let arguments = ["render", "grid:4", "--size", "80x60", "-o"];
    let file = file.to_str().unwrap();
    succeeds(&[&arguments[..], &[file], asked].concat());
}

fn open(folder: &Path, name: &str) -> RgbImage {
    image::open(folder.join(name)).unwrap().into_rgb8()
}

#[test]
fn two_eyes_are_laid_out_in_three_ways() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    rendered(folder, "beside.png", &["--stereo"]);
    rendered(folder, "grid.png", &["--layout", "separate"]);
    rendered(folder, "glasses.png", &["--stereo", "--layout", "red-cyan"]);
    let beside = open(folder, "beside.png");
    let (left, right) = (
        open(folder, "grid-left.png"),
        open(folder, "grid-right.png"),
    );
    let glasses = open(folder, "glasses.png");
    assert!(!folder.join("grid.png").exists());
    assert_eq!(beside.dimensions(), (160, 60));
    for (name, image) in [("left", &left), ("right", &right), ("glasses", &glasses)] {
        assert_eq!(image.dimensions(), (80, 60), "{name}");
    }
    assert_ne!(left, right);
    for (x, y, pixel) in left.enumerate_pixels() {
        assert_eq!(pixel, beside.get_pixel(x, y));
        assert_eq!(right.get_pixel(x, y), beside.get_pixel(x + 80, y));
    }
    let edge = |x: u32, y: u32| left.get_pixel(x, y) != right.get_pixel(x, y);
    let coloured = |x: u32, y: u32| {
        let [r, _, b] = glasses.get_pixel(x, y).0;
        r.abs_diff(b) > 60
    };
    let all = || (0..60).flat_map(|y| (0..80).map(move |x| (x, y)));
    assert!(all().any(|(x, y)| coloured(x, y)));
    assert!(
        all()
            .filter(|(x, y)| coloured(*x, *y))
            .all(|(x, y)| edge(x, y))
    );
}

#[test]
fn the_distances_are_followed() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    rendered(folder, "one.png", &[]);
    let apart = |interocular: &str| {
        rendered(
            folder,
            "two.png",
            &["--interocular", interocular, "--layout", "separate"],
        );
        (open(folder, "two-left.png"), open(folder, "two-right.png"))
    };
    let (left, right) = apart("0");
    assert_eq!((&left, &right), (&open(folder, "one.png"), &right));
    assert_eq!(left, right);
    let differ = |(left, right): (RgbImage, RgbImage)| {
        left.pixels()
            .zip(right.pixels())
            .filter(|(l, r)| l != r)
            .count()
    };
    assert!(differ(apart("0.02")) < differ(apart("0.5")));
}

#[test]
fn eyes_that_cannot_be_are_refused_with_the_range() {
    for bad in ["0", "-1", "NaN", "inf", "far"] {
        let arguments = ["render", "grid:2", "-o", "none.png", "--convergence", bad];
        refuses(&arguments, 2, &["--convergence", "above 0"]);
    }
    for bad in ["-0.1", "NaN", "wide"] {
        let arguments = ["compare", "grid:2", "--interocular", bad];
        refuses(&arguments, 2, &["--interocular", "0 or more"]);
    }
    let sideways = ["render", "grid:2", "-o", "none.png", "--layout", "sideways"];
    refuses(&sideways, 2, &["side-by-side", "red-cyan", "separate"]);
    let dir = tempfile::tempdir().unwrap();
    let flat = dir.path().join("flat.json");
    let text = r#"{"projection":{"orthographic":{"height":10,"near":-5,"far":50}},"poses":[{"eye":[0,0,9],"target":[0,0,0]}]}"#;
    std::fs::write(&flat, text).unwrap();
    let path = flat.to_str().unwrap();
    let arguments = [
        "compare", "grid:2", "--size", "32x32", "--stereo", "--path", path,
    ];
    refuses(&arguments, 2, &["orthographic"]);
}

#[test]
fn a_comparison_in_stereo_reports_both_eyes() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().to_str().unwrap();
    let text = succeeds(&[
        "compare",
        "grid:4",
        "--frames",
        "2",
        "--size",
        "96x72",
        "--stereo",
        "--convergence",
        "12",
        "--strategies",
        "frustum,three-pass:latency=same-frame",
        "--out",
        out,
    ]);
    assert!(
        text.contains("2 views (eyes 0.4 m apart, converging at 12 m)"),
        "{text}"
    );
    assert!(
        text.contains("left, mean %") && text.contains("right, max %"),
        "{text}"
    );
    let bytes = std::fs::read(dir.path().join("report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(report["scene"]["views"], 2);
    assert_eq!(report["scene"]["stereo"]["convergence"], 12.0);
    assert_eq!(report["scene"]["stereo"]["interocular"], 0.4);
    for strategy in report["strategies"].as_array().unwrap() {
        assert_eq!(strategy["views"].as_array().unwrap().len(), 2);
        assert_eq!(strategy["queries_a_view"].as_array().unwrap().len(), 2);
    }
    let html = std::fs::read_to_string(dir.path().join("report.html")).unwrap();
    assert!(html.contains("Each eye"));
}

#[test]
fn a_graph_of_two_eyes_has_both() {
    let text = succeeds(&[
        "graph",
        "grid:3",
        "--size",
        "64x48",
        "--strategy",
        "three-pass:latency=same-frame",
        "--stereo",
        "--format",
        "json",
    ]);
    let graph: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(graph["sync_points"], 1, "both eyes wait once");
    assert!(text.contains("left: view") && text.contains("right: view"));
}
