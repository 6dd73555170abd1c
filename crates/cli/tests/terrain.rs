//! Terrain from the command line: the built-in landscape under its own strategy, and what is refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::io::Write;
use std::path::Path;

use common::{antumbra, refuses, stderr, succeeds};
use serde_json::Value;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// A NumPy archive of ridges, behind which valleys lie hidden, and its name.
fn ridges(folder: &Path) -> String {
    let side = 49_u16;
    let height = |row: u16, column: u16| {
        let [row, column] = [row, column].map(f32::from);
        300.0 * (row * 0.3).cos() + 12.0 * (column * 0.8 + row).sin()
    };
    let mut head =
        format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({side}, {side}), }}\n");
    while (head.len() + 10) % 64 != 0 {
        head.insert(head.len() - 1, ' ');
    }
    let mut elevation = b"\x93NUMPY\x01\x00".to_vec();
    elevation.extend((head.len() as u16).to_le_bytes());
    elevation.extend(head.into_bytes());
    let posts = (0..side).flat_map(|row| (0..side).map(move |column| height(row, column)));
    elevation.extend(posts.flat_map(f32::to_le_bytes));
    let mut spacing = b"\x93NUMPY\x01\x00".to_vec();
    let head = "{'descr': '<f8', 'fortran_order': False, 'shape': (), }            \n";
    spacing.extend((head.len() as u16).to_le_bytes());
    spacing.extend(head.bytes());
    spacing.extend(30.0_f64.to_le_bytes());
    let file = folder.join("dem.npz");
    let mut archive = ZipWriter::new(std::fs::File::create(&file).unwrap());
    let stored = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (name, array) in [
        ("elevation", &elevation),
        ("dx", &spacing),
        ("dy", &spacing),
    ] {
        archive.start_file(format!("{name}.npy"), stored).unwrap();
        archive.write_all(array).unwrap();
    }
    archive.finish().unwrap();
    file.to_str().unwrap().to_owned()
}

/// Compares `horizon` with `frustum`: nothing is wrong. How much of what `frustum` draws is drawn.
fn drawn(scene: &str, out: &Path) -> f64 {
    let out_name = out.to_str().unwrap();
    let common = [
        "--frames", "12", "--size", "160x120", "--quiet", "--out", out_name,
    ];
    let arguments = ["compare", scene, "--strategies", "frustum,horizon"];
    succeeds(&[&arguments[..], &common[..]].concat());
    let report = std::fs::read_to_string(out.join("report.json")).unwrap();
    let report: Value = serde_json::from_str(&report).unwrap();
    let [frustum, horizon] = [0, 1].map(|at| &report["strategies"][at]);
    let drawn = |strategy: &Value| strategy["drawn"]["triangles"].as_f64().unwrap();
    assert_eq!(horizon["error"]["wrong_pixels_percent"]["max"], 0.0);
    assert_eq!(horizon["error"]["false_culls"]["entities"], 0);
    drawn(horizon) / drawn(frustum)
}

#[test]
fn a_raster_becomes_a_file_that_is_compared_without_preparing_again() {
    let folder = tempfile::tempdir().unwrap();
    let raster = ridges(folder.path());
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let terrain = at("terrain.glb");
    let made = ["prepare", &raster, "-o", &terrain, "--vertices", "1800"];
    let said = succeeds(
        &[
            &made[..],
            &["--sectors", "32", "--parts", "4", "--seeds", "90"],
        ]
        .concat(),
    );
    assert!(
        said.contains("horizons in 32 sectors of 4, sound"),
        "{said}"
    );
    let drawn = drawn(&terrain, &folder.path().join("out"));
    assert!(drawn < 0.95, "{drawn}");
    // A mesh of it is a terrain too; a detail it has none.
    let again = at("again.glb");
    let said = succeeds(&[
        "prepare",
        &terrain,
        "-o",
        &again,
        "--sectors",
        "8",
        "--parts",
        "2",
    ]);
    assert!(said.contains("horizons in 8 sectors of 2"), "{said}");
    let bad = ["prepare", &terrain, "-o", &again, "--error", "2"];
    refuses(&bad, 2, &["taken whole"]);
    // What the file says of its terrain is damaged: the scene is shown all the same, and it is said why it has no horizons.
    let bytes = std::fs::read(&again).unwrap();
    let text = b"\"method\":\"sound\"";
    let place = bytes.windows(text.len()).position(|window| window == text);
    let mut broken = bytes.clone();
    broken[place.unwrap() + 10] = b'f';
    std::fs::write(&again, broken).unwrap();
    let image = at("image.png");
    let draw = ["render", &again, "--size", "64x48", "-o", &image];
    let output = antumbra(&draw);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(
        stderr(&output).contains("\"method\" is not sound"),
        "{}",
        stderr(&output)
    );
    let horizon = [&draw[..], &["--strategy", "horizon"]].concat();
    refuses(&horizon, 2, &["without its horizons", "no terrain"]);
}

#[test]
fn a_raster_is_a_scene() {
    let folder = tempfile::tempdir().unwrap();
    let drawn = drawn(&ridges(folder.path()), &folder.path().join("out"));
    assert!(drawn <= 1.0, "{drawn}");
}

#[test]
fn what_is_to_be_made_is_told_or_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (grid, out) = (at("dem.asc"), at("out.glb"));
    let posts = "0 1 2\n1 5 1\n2 1 0\n";
    let head = "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\n";
    std::fs::write(&grid, format!("{head}{posts}")).unwrap();
    let prepare = ["prepare", grid.as_str(), "-o", out.as_str()];
    let horizon = [&prepare[..], &["--tiles", "2", "--as", "subsurface"]].concat();
    let said = succeeds(&horizon);
    assert!(said.contains("1 horizons"), "{said}");
    for asked in [&[][..], &["--as", "terrain"]] {
        let said = succeeds(&[&prepare[..], asked].concat());
        assert!(said.contains("9 vertices and 8 triangles"), "{said}");
    }
    // Which of the two it was is said where it was not asked for.
    let noted = |arguments: &[&str]| stderr(&antumbra(arguments));
    assert!(noted(&prepare).contains("--as subsurface"));
    assert!(!noted(&horizon).contains("--as"));
    let two = ["prepare", &grid, &grid, "-o", &out];
    assert!(noted(&two).contains("is made a horizon"));
    let quiet = [&two[..], &["--quiet"]].concat();
    assert_eq!(noted(&quiet), "");
    let asked = [&two[..], &["--vertices", "5"]].concat();
    refuses(&asked, 2, &["--as terrain"]);
    let both = [
        &prepare[..],
        &["--as", "terrain", "--vertices", "5", "--error", "1"],
    ]
    .concat();
    refuses(&both, 2, &["cannot be used with"]);
    let two = ["prepare", &grid, &grid, "-o", &out, "--as", "terrain"];
    refuses(&two, 2, &["one input"]);
    let other = at("surface.gri");
    refuses(
        &["prepare", &other, "-o", &out, "--as", "terrain"],
        2,
        &["neither a raster"],
    );
    refuses(&["prepare", &at("no.npz"), "-o", &out], 1, &["no.npz"]);
    let built_in = [
        "prepare",
        "terrain:300:order=5",
        "-o",
        &out,
        "--sectors",
        "4",
        "--parts",
        "2",
    ];
    let said = succeeds(&[&built_in[..], &["--seed", "7"]].concat());
    assert!(said.contains("horizons in 4 sectors of 2"), "{said}");
    refuses(
        &[&built_in[..], &["--error", "7"]].concat(),
        2,
        &["for rasters"],
    );
    refuses(
        &[&built_in[..], &["--method", "magic"]].concat(),
        2,
        &["sound, rays or thesis"],
    );
}

/// The strategies of a comparison's report.
fn compared(scene: &str, strategies: &[&str], more: &[&str]) -> Vec<Value> {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().to_str().unwrap();
    let strategies = strategies.join(",");
    let arguments = ["compare", scene, "--strategies", &strategies, "--out", out];
    succeeds(&[&arguments[..], more].concat());
    let report = std::fs::read_to_string(dir.path().join("report.json")).unwrap();
    let report: Value = serde_json::from_str(&report).unwrap();
    report["strategies"].as_array().unwrap().clone()
}

fn assert_right(strategy: &Value) {
    let name = &strategy["settings"];
    assert_eq!(strategy["conservative"], true, "{name}");
    assert_eq!(
        strategy["error"]["wrong_pixels_percent"]["max"], 0.0,
        "{name}"
    );
    assert_eq!(strategy["error"]["false_culls"]["entities"], 0, "{name}");
}

const LANDSCAPE: &str = "terrain:8000:order=8:roughness=0.35:sectors=32:parts=4:seeds=250";

#[test]
fn horizons_cull_terrain_and_what_stands_on_it_and_no_pixel_of_either() {
    let size = ["--frames", "24", "--size", "160x120"];
    let [bare, built] = [LANDSCAPE.to_owned(), format!("{LANDSCAPE}:boxes=300")]
        .map(|scene| compared(&scene, &["frustum", "horizon"], &size));
    let drawn = |strategy: &Value, what: &str| strategy["drawn"][what].as_f64().unwrap();
    for compared in [&bare, &built] {
        let [frustum, horizon] = [&compared[0], &compared[1]];
        assert_eq!(horizon["name"], "horizon");
        assert_eq!(horizon["settings"]["then"], "frustum");
        assert_right(horizon);
        assert_eq!(horizon["queries"], 0.0);
        let [all, left] = [frustum, horizon].map(|strategy| drawn(strategy, "triangles"));
        assert!(left < 0.95 * all, "{left} of {all}");
    }
    // What there is more of is boxes.
    let boxes = |at: usize| drawn(&built[at], "entities") - drawn(&bare[at], "entities");
    let [inside, left] = [0, 1].map(boxes);
    assert!(inside > 20.0, "{inside}");
    assert!(left < 0.8 * inside, "{left} of {inside}");
}

/// `horizon` alone, then with each other strategy next, in the latencies that it has.
const THEN: [&str; 16] = [
    "horizon",
    "horizon:then=none",
    "horizon:then=ideal",
    "horizon:then=stop-and-wait",
    "horizon:then=stop-and-wait:tree=divided",
    "horizon:then=three-pass:latency=same-frame:threshold=0:scale=1:occluders=full:occludees=full",
    "horizon:then=three-pass:latency=frame-late",
    "horizon:then=three-pass:latency=on-gpu",
    "horizon:then=coherent:latency=same-frame",
    "horizon:then=coherent:latency=frame-late",
    "horizon:then=stereo-coherent:latency=same-frame",
    "horizon:then=stereo-coherent:latency=frame-late",
    "horizon:then=stereo-coherent:latency=on-gpu",
    "horizon:then=occupancy-map:latency=same-frame:worth=0",
    "horizon:then=occupancy-map:latency=frame-late",
    "horizon:then=occupancy-map-single",
];

#[test]
fn whatever_follows_the_horizon_culls_more_and_is_as_right_as_it_is() {
    let scene = "terrain:1500:order=6:roughness=0.3:sectors=16:parts=4:seeds=40:boxes=60";
    for eyes in [&[][..], &["--stereo"][..]] {
        let size = ["--frames", "6", "--size", "96x72"];
        let compared = compared(scene, &THEN, &[&size, eyes].concat());
        assert_eq!(compared.len(), THEN.len());
        let occluded = |strategy: &Value| strategy["verdicts"]["occluded"].as_f64().unwrap();
        let alone = occluded(&compared[0]);
        assert!(alone > 1.0, "{alone}");
        for (strategy, text) in compared.iter().zip(THEN) {
            let waits = !text.contains("frame-late");
            let exact = !text.contains("three-pass") || text.contains("occludees=full");
            assert_eq!(strategy["conservative"], waits && exact, "{text}");
            if waits && exact {
                assert_right(strategy);
            }
            // The next strategy does not draw what the terrain hides.
            assert!(occluded(strategy) >= alone - 1e-9, "{text}");
        }
    }
}

#[test]
fn what_the_horizon_is_told_goes_to_whoever_it_is_for() {
    let draw = |strategy: &'static str| {
        let scene = "terrain:60:order=3:sectors=4:parts=1";
        ["render", scene, "--strategy", strategy, "-o", "no.png"]
    };
    for (strategy, words) in [
        ("horizon:then=magic", ["magic", "occupancy-map"]),
        ("horizon:then=horizon", ["'horizon' is no strategy", "then"]),
        ("horizon:grain=3", ["horizon:then=frustum", "grain"]),
        (
            "horizon:then=occupancy-map:seeds=3",
            ["'occupancy-map'", "worth"],
        ),
    ] {
        refuses(&draw(strategy), 2, &words);
    }
}

#[test]
fn what_is_no_landscape_and_what_has_none_is_refused() {
    let draw = |scene: &'static str| ["render", scene, "--strategy", "horizon", "-o", "no.png"];
    refuses(&draw("grid:3"), 2, &["horizon", "no terrain"]);
    refuses(&draw("terrain:9:colour=red"), 1, &["colour", "relief"]);
    refuses(&draw("terrain:9:order=99"), 1, &["order", "99", "1 to 13"]);
    refuses(&draw("terrain:9:sectors=2"), 1, &["sectors", "4 to 1024"]);
    refuses(&draw("terrain:9:method=magic"), 1, &["sound"]);
    refuses(&draw("terrain:60:boxes=-1"), 1, &["boxes", "number"]);
    refuses(&draw("terrain:60:boxes=9999999"), 1, &["boxes", "1000000"]);
    refuses(&draw("terrain:3"), 1, &["vertices", "4 or more"]);
}
