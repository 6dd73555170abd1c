//! Terrain from the command line: the built-in landscape under its own strategy, and what is refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{refuses, succeeds};
use serde_json::Value;

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

/// Every strategy there is but this one, in what latencies it has, with fewer boxes than somebody would wait for.
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
            // Nobody takes back what the terrain hides.
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
