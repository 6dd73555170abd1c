//! The command line as a person meets it: exit status, what is printed, what is written.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::io::Write;
use std::path::Path;

use common::{antumbra, program, refuses, stderr};

fn report(dir: &Path) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(dir.join("report.json")).unwrap()).unwrap()
}

#[test]
fn a_comparison_prints_a_table_and_writes_a_report() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("deep/out");
    let output = antumbra(&[
        "compare",
        "grid:4",
        "--frames",
        "4",
        "--size",
        "160x120",
        "--out",
        out.to_str().unwrap(),
    ]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    for word in [
        "none",
        "frustum",
        "ideal",
        "stop-and-wait",
        "three-pass late",
        "coherent same",
        "report.html",
    ] {
        assert!(text.contains(word), "'{word}' is not in: {text}");
    }
    // In a pipe nothing moves and nothing is coloured.
    assert!(!text.contains('\u{1b}') && !stderr(&output).contains('\u{1b}'));

    let report = report(&out);
    assert_eq!(report["scene"]["entities"], 64);
    assert!(report["seeds"]["scene"].is_u64() && report["seeds"]["path"].is_u64());
    assert_eq!(report["scene"]["size"], serde_json::json!([160, 120]));
    assert!(report["noise"]["frame_time_ratio_p95"].as_f64().unwrap() >= 1.0);
    let strategies = report["strategies"].as_array().unwrap();
    assert_eq!(strategies.len(), 13);
    for strategy in strategies {
        let series = |name: &str| {
            let series = strategy["frames"][name].as_array().unwrap();
            series
                .iter()
                .map(|value| value.as_f64().unwrap())
                .collect::<Vec<_>>()
        };
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len() as f64;
        let drawn = strategy["drawn"]["triangles"].as_f64().unwrap();
        assert!((mean(series("drawn_triangles")) - drawn).abs() < 1e-6);
        assert!((mean(series("queries")) - strategy["queries"].as_f64().unwrap()).abs() < 1e-6);
        let most = series("sync_points").into_iter().fold(0.0, f64::max);
        assert_eq!(Some(most), strategy["sync_points"].as_f64());
        if strategy["conservative"] == true {
            assert_eq!(
                strategy["error"]["false_culls"]["entities"], 0,
                "{}",
                strategy["name"]
            );
            assert_eq!(
                strategy["error"]["wrong_pixels_percent"]["max"], 0.0,
                "{}",
                strategy["name"]
            );
        }
        assert_eq!(strategy["frames"]["frame_ms"].as_array().unwrap().len(), 4);
        assert!(strategy["time_vs_frustum"].as_f64().unwrap() > 0.0);
    }
    let html = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(html.starts_with("<!doctype html>") && html.contains("three-pass late"));
}

#[test]
fn settings_reach_the_strategy_and_the_report() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().to_str().unwrap();
    let arguments = [
        "compare", "grid:3", "--frames", "2", "--size", "64x48", "--quiet", "--out", out,
    ];
    let set = [
        "--strategies",
        "three-pass",
        "--set",
        "three-pass.threshold=7",
        "--latency",
        "on-gpu",
    ];
    let output = antumbra(&[&arguments[..], &set[..]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(output.stdout.is_empty());
    let report = report(dir.path());
    assert_eq!(report["strategies"].as_array().unwrap().len(), 1);
    assert_eq!(report["strategies"][0]["settings"]["threshold"], 7);
    assert_eq!(report["strategies"][0]["latency"], "on-gpu");
}

#[test]
fn wrong_words_are_refused_with_what_there_is() {
    refuses(
        &["compare", "--strategies", "magic"],
        2,
        &["magic", "three-pass", "stop-and-wait"],
    );
    refuses(
        &["compare", "--set", "three-pass.colour=red"],
        2,
        &["colour", "latency", "threshold"],
    );
    refuses(
        &["compare", "--set", "three-pass.threshold=-1"],
        2,
        &["-1", "threshold", "0 to 1000000"],
    );
    refuses(
        &["compare", "--set", "threshold=1"],
        2,
        &["STRATEGY.KEY=VALUE"],
    );
    refuses(&["compare", "gird"], 2, &["gird", "grid"]);
    refuses(&["compare", "grid:huge"], 2, &["huge"]);
    refuses(&["compare", "--size", "0x10"], 2, &["1280x1024"]);
    refuses(&["compare", "--frames", "0"], 2, &["frames"]);
    refuses(&["compare", "--latency", "tomorrow"], 2, &["frame-late"]);
    refuses(&["dance"], 2, &["dance"]);
    let conflict = [
        "graph",
        "grid:2",
        "--size",
        "32x32",
        "--strategy",
        "three-pass:counting=queries:threshold=5",
    ];
    refuses(&conflict, 2, &["three-pass", "threshold", "counting"]);
}

#[test]
fn no_adapter_says_what_to_install() {
    refuses(
        &["compare", "grid:2", "--adapter", "no such card"],
        1,
        &["no such card", "mesa-vulkan-drivers"],
    );
}

#[test]
fn broken_files_are_named_with_what_is_wrong() {
    let dir = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| {
        let path = dir.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let gltf = |body: &str| format!(r#"{{"asset":{{"version":"2.0"}},{body}}}"#);
    let missing = dir.path().join("missing.glb");
    refuses(&["compare", missing.to_str().unwrap()], 1, &["missing.glb"]);
    let truncated = write(
        "truncated.glb",
        b"glTF\x02\0\0\0\xff\xff\0\0\x10\0\0\0JSON{\"asset\":",
    );
    refuses(&["compare", &truncated], 1, &["truncated.glb"]);
    let lying = write(
        "lying.glb",
        b"glTF\x02\0\0\0\xff\xff\xff\xff\xf0\xff\xff\xffJSON{}",
    );
    refuses(&["compare", &lying], 1, &["lying.glb"]);
    let extension = write(
        "extension.gltf",
        gltf(r#""extensionsUsed":["EXT_dream"],"extensionsRequired":["EXT_dream"]"#).as_bytes(),
    );
    refuses(&["compare", &extension], 1, &["EXT_dream"]);
    let cycle = write(
        "cycle.gltf",
        gltf(r#""scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}]"#)
            .as_bytes(),
    );
    refuses(&["compare", &cycle], 1, &["cycle.gltf"]);
    let buffer = write(
        "buffer.gltf",
        gltf(
            r#""buffers":[{"uri":"gone.bin","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0"#,
        )
        .as_bytes(),
    );
    refuses(&["compare", &buffer], 1, &["gone.bin"]);
    let nan = write("nan.obj", b"v 0 0 0\nv nan 1 0\nv 0 1 0\nf 1 2 3\n");
    refuses(&["compare", &nan], 1, &["nan.obj"]);
    let index = write("index.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    refuses(&["compare", &index], 1, &["index.obj"]);
}

#[test]
fn frames_in_flight_age_late_answers() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    let shared = [
        "grid:4",
        "--size",
        "64x48",
        "--frames",
        "4",
        "--in-flight",
        "2",
    ];
    let compare = ["compare", "--strategies", "coherent,frustum", "--out"];
    let out_text = out.to_str().unwrap();
    let output = antumbra(&[&compare[..], &[out_text], &shared].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    let compared = report(&out);
    assert_eq!(compared["scene"]["in_flight"], 2);
    let [coherent, frustum] = [0, 1].map(|at| &compared["strategies"][at]);
    assert_eq!(coherent["answers"]["youngest"], 2);
    assert_eq!(coherent["answers"]["oldest"], 2);
    assert_eq!(
        coherent["frames"]["answer_age"],
        serde_json::json!([0, 0, 2, 2])
    );
    assert!(frustum["answers"].is_null());
    let sweep = [
        "sweep",
        "--strategy",
        "coherent",
        "--vary",
        "together=1,8",
        "--out",
    ];
    let output = antumbra(&[&sweep[..], &[out_text], &shared].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    let swept = report(&out);
    assert_eq!(swept["scene"]["in_flight"], 2);
    for refused in ["0", "9", "two"] {
        let shared = ["grid:2", "--out", out_text, "--in-flight", refused];
        refuses(&[&["compare"], &shared[..]].concat(), 2, &["--in-flight"]);
    }
}

#[test]
fn several_samples_a_pixel_are_compared_and_drawn() {
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name).to_str().unwrap().to_owned();
    let out = at("out");
    let shared = ["grid:5", "--size", "96x72", "--samples"];
    let compare = [
        "--frames",
        "3",
        "--strategies",
        "coherent:latency=on-gpu,ideal",
        "--out",
        &out,
    ];
    let output = antumbra(&[&["compare"], &shared[..], &["4"], &compare].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    let report = report(Path::new(&out));
    assert_eq!(report["scene"]["samples"], 4);
    for strategy in report["strategies"].as_array().unwrap() {
        let error = &strategy["error"];
        assert_eq!(error["wrong_pixels_percent"]["max"], 0.0, "{strategy}");
        assert_eq!(error["false_culls"]["entities"], 0, "{strategy}");
    }
    // With four samples the silhouettes have shades between those of the spheres and of the background.
    let shades = |samples: &str| {
        let file = at("image.png");
        let output = antumbra(&[&["render"], &shared[..], &[samples, "-o", &file]].concat());
        assert!(output.status.success(), "{}", stderr(&output));
        let image = image::open(&file).unwrap().into_rgb8();
        image
            .pixels()
            .map(|pixel| pixel.0)
            .collect::<std::collections::HashSet<_>>()
            .len()
    };
    let (one, four) = (shades("1"), shades("4"));
    assert!(four > one + 100, "{one} and {four} colours");
    let refused = ["render", "grid:2", "-o", &at("none.png"), "--samples"];
    refuses(&[&refused[..], &["3"]].concat(), 2, &["1, 2, 4, 8 or 16"]);
    refuses(
        &[&refused[..], &["16"]].concat(),
        1,
        &["16 samples a pixel", "[1, 4]"],
    );
}

#[test]
fn an_image_is_drawn() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("grid.png");
    let arguments = [
        "render",
        "grid:5",
        "--size",
        "128x96",
        "--strategy",
        "three-pass:latency=same-frame",
        "--show-culled",
        "-o",
    ];
    let output = antumbra(&[&arguments[..], &[file.to_str().unwrap()]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    let image = image::open(&file).unwrap().into_rgb8();
    assert_eq!(image.dimensions(), (128, 96));
    let magenta = image
        .pixels()
        .filter(|p| p.0[0] > p.0[1].saturating_add(40) && p.0[2] > p.0[1].saturating_add(30))
        .count();
    assert!(magenta > 100, "only {magenta} pixels show what was culled");
}

#[test]
fn a_graph_shows_why_a_frame_stalls() {
    let picture = |latency: &str, format: &str| {
        let strategy = format!("three-pass:latency={latency}");
        let output = antumbra(&[
            "graph",
            "grid:3",
            "--size",
            "64x48",
            "--strategy",
            &strategy,
            "--format",
            format,
        ]);
        assert!(output.status.success(), "{}", stderr(&output));
        String::from_utf8(output.stdout).unwrap()
    };
    let json: serde_json::Value = serde_json::from_str(&picture("same-frame", "json")).unwrap();
    assert_eq!(json["sync_points"], 1);
    let json: serde_json::Value = serde_json::from_str(&picture("frame-late", "json")).unwrap();
    assert_eq!(json["sync_points"], 0);
    assert!(picture("frame-late", "dot").contains("dashed"));
    assert!(picture("on-gpu", "mermaid").contains("compact"));
}

#[test]
fn the_doctor_lists_adapters_and_ways_of_counting() {
    let output = antumbra(&["doctor"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    for word in [
        "vulkan",
        "counting by queries: yes",
        "counting by identity",
        "TIMESTAMP_QUERY",
    ] {
        assert!(
            text.to_lowercase().contains(&word.to_lowercase()),
            "'{word}' is not in: {text}"
        );
    }
}

#[test]
fn the_doctor_tries_each_driver_and_says_what_it_found() {
    let output = antumbra(&["doctor", "--self-test"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    for words in [
        "self-test with one sample a pixel: every answer is right",
        "self-test with 4 samples a pixel: every answer is right",
        "counting by atomics: passed",
        "counting by compare: not available, it lacks shaders that read the samples of what was drawn",
        "occlusion queries: passed",
        "depth pyramid: passed",
        "box tests: passed",
        "compaction: passed",
        "indirect draws with first instance: passed",
    ] {
        assert!(text.contains(words), "'{words}' is not in: {text}");
    }
    assert!(!text.contains("FAILED"), "{text}");
    let plain = antumbra(&["doctor"]);
    assert!(!String::from_utf8_lossy(&plain.stdout).contains("self-test"));
}

/// What a file can say of it, on the command line; every way a file can be wrong is read in `crates/measure/tests/path.rs`.
#[test]
fn a_path_file_with_a_number_beyond_all_names_the_pose() {
    let mut file = tempfile::NamedTempFile::with_suffix(".json").unwrap();
    let text = r#"{"projection": {"perspective": {"fov_y_degrees": 45, "near": 0.1}},
        "poses": [{"eye": [0, 0, 9], "target": [0, 0, 0]}, {"eye": [0, 0, 1e999], "target": [0, 0, 0]}]}"#;
    file.write_all(text.as_bytes()).unwrap();
    let path = file.path().to_str().unwrap();
    refuses(
        &["compare", "grid:2", "--path", path, "--size", "32x24"],
        1,
        &["pose 1", "out of range"],
    );
}

#[test]
fn a_broken_file_is_named_once() {
    let dir = tempfile::tempdir().unwrap();
    let file = |name: &str| dir.path().join(name).to_str().unwrap().to_owned();
    let [out, made] = ["out", "made.glb"].map(file);
    let once = |arguments: &[&str], status: i32| {
        let output = antumbra(arguments);
        let message = stderr(&output);
        assert_eq!(
            output.status.code(),
            Some(status),
            "{arguments:?}: {message}"
        );
        assert_eq!(message.matches("broken").count(), 1, "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
    };
    let compare =
        |more: &[&str], status| once(&[&["compare", "--out", &out], more].concat(), status);
    let terrain =
        |file: &str, status| once(&["prepare", file, "-o", &made, "--as", "terrain"], status);
    let surface = |file: &str, status| once(&["prepare", file, "-o", &made], status);
    let stl = [&[0; 80][..], &100_u32.to_le_bytes()].concat();
    let cut_off: [(&str, &[u8]); 10] = [
        (
            "glb",
            b"glTF\x02\0\0\0\xff\xff\0\0\x10\0\0\0JSON{\"asset\":",
        ),
        ("gltf", b"{\"asset\":"),
        ("json", b"{\"type\":"),
        ("jsonl", b"{\"type\":"),
        ("obj", b"v 0 0 0\nf 1 2 9\n"),
        ("ply", b"ply\nformat ascii 1.0\nelement vertex 3\n"),
        ("stl", &stl),
        ("npz", b"PK\x03\x04"),
        ("tif", b"II*\0\x08\0\0\0"),
        ("asc", b"ncols 2\nnrows 2\n"),
    ];
    for (ending, bytes) in cut_off {
        let file = file(&format!("broken.{ending}"));
        // Missing, then cut off.
        for _ in 0..2 {
            compare(&[&file], 1);
            terrain(&file, 1);
            std::fs::write(&file, bytes).unwrap();
        }
        compare(&[&file], 1);
        terrain(&file, 1);
    }
    for ending in ["gri", "irap", "roff", "ts", "csv", "asc", "tif"] {
        let file = file(&format!("broken.{ending}"));
        surface(&file, 1);
        std::fs::write(&file, "v nothing 0 0\n").unwrap();
        surface(&file, 1);
    }
    // An ending that no format has; without a file it may be meant as a built-in scene.
    let file = file("broken.data");
    compare(&[&file], 2);
    for written in [false, true] {
        compare(&["grid:2", "--path", &file], 1);
        compare(&["grid:2", "--volume", &file], 1);
        surface(&file, 1);
        terrain(&file, 2);
        if !written {
            std::fs::write(&file, "nothing").unwrap();
        }
    }
    compare(&[&file], 1);
}

/// A reader that leaves ends the program without a complaint.
#[test]
fn a_closed_pipe_is_no_failure() {
    for arguments in [
        &["strategies"][..],
        &["doctor"],
        &["graph", "grid:2", "--strategy", "none"],
    ] {
        let mut child = program(arguments).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert!(output.stderr.is_empty(), "{}", stderr(&output));
    }
}

#[test]
fn quiet_commands_print_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let file = |name: &str| dir.path().join(name).to_str().unwrap().to_owned();
    let [image, scene] = ["image.png", "scene.glb"].map(file);
    let render = ["render", "grid:2", "--size", "32x24", "-o", &image];
    let prepare = ["prepare", "terrain:300", "--sectors", "8", "-o", &scene];
    for (arguments, written) in [(&render[..], &image), (&prepare, &scene)] {
        let loud = antumbra(arguments);
        assert!(loud.status.success(), "{}", stderr(&loud));
        let said = String::from_utf8_lossy(&loud.stdout).into_owned();
        assert!(said.contains(written.as_str()), "{said}");
        let quiet = antumbra(&[arguments, &["--quiet"]].concat());
        assert!(quiet.status.success() && quiet.stdout.is_empty());
        assert!(quiet.stderr.is_empty(), "{}", stderr(&quiet));
    }
}

#[test]
fn an_image_that_lacks_visible_entities_says_so_on_standard_error() {
    let dir = tempfile::tempdir().unwrap();
    let image = dir.path().join("image.png").to_string_lossy().into_owned();
    let drawn = |strategy: &str, more: &[&str]| {
        let render = ["render", "grid:4", "--size", "96x72", "-o", &image];
        let output = antumbra(&[&render[..], &["--strategy", strategy], more].concat());
        assert!(output.status.success(), "{}", stderr(&output));
        stderr(&output)
    };
    // More pixels than the image has: nothing is drawn.
    let losing = "three-pass:latency=same-frame:threshold=7000";
    let said = drawn(losing, &[]);
    assert!(said.contains("visible entities are not drawn"), "{said}");
    assert!(
        said.contains("100 % of the pixels that entities own"),
        "{said}"
    );
    assert_eq!(said.lines().count(), 1, "{said}");
    assert_eq!(drawn(losing, &["--quiet"]), "");
    for right in ["frustum", "coherent:latency=same-frame"] {
        assert_eq!(drawn(right, &[]), "", "{right}");
    }
}
