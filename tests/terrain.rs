//! Terrain from the command line: the built-in landscape under its own strategy, and what is refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{refuses, succeeds};
use serde_json::Value;

#[test]
fn horizons_cull_terrain_and_no_pixel_of_it() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().to_str().unwrap();
    succeeds(&[
        "compare",
        "terrain:8000:order=8:roughness=0.35:sectors=32:parts=4:seeds=250",
        "--strategies",
        "frustum,horizon",
        "--frames",
        "24",
        "--size",
        "160x120",
        "--out",
        out,
    ]);
    let report = std::fs::read_to_string(dir.path().join("report.json")).unwrap();
    let report: Value = serde_json::from_str(&report).unwrap();
    let [frustum, horizon] = [0, 1].map(|at| &report["strategies"][at]);
    assert_eq!(horizon["name"], "horizon");
    assert_eq!(horizon["conservative"], true);
    let drawn = |strategy: &Value| strategy["drawn"]["triangles"].as_f64().unwrap();
    assert!(drawn(horizon) < 0.95 * drawn(frustum), "{}", drawn(horizon));
    assert_eq!(horizon["error"]["wrong_pixels_percent"]["max"], 0.0);
    assert_eq!(horizon["error"]["false_culls"]["entities"], 0);
    assert_eq!(horizon["queries"], 0.0);
}

#[test]
fn what_is_no_landscape_and_what_has_none_is_refused() {
    let draw = |scene: &'static str| ["render", scene, "--strategy", "horizon", "-o", "no.png"];
    refuses(&draw("grid:3"), 2, &["horizon", "no terrain"]);
    refuses(&draw("terrain:9:colour=red"), 1, &["colour", "relief"]);
    refuses(&draw("terrain:9:order=99"), 1, &["order", "99", "1 to 13"]);
    refuses(&draw("terrain:9:sectors=2"), 1, &["sectors", "4 to 1024"]);
    refuses(&draw("terrain:9:method=magic"), 1, &["sound"]);
    refuses(&draw("terrain:3"), 1, &["vertices", "4 or more"]);
}
