//! What was compared, in words: what goes above a table.

use super::motion;
use crate::format;
use crate::report::{MissingParts, Report};

/// The comparison in two lines: first the scene with the views and the path, then the adapter and the noise.
pub fn facts(report: &Report) -> [String; 2] {
    let scene = &report.scene;
    let path = if scene.path.is_empty() {
        String::new()
    } else {
        format!(" along {}", format::clean(&scene.path))
    };
    let [width, height] = scene.size;
    let samples = match scene.samples {
        1 => String::new(),
        many => format!(" of {many} samples"),
    };
    let in_flight = match scene.in_flight {
        None | Some(1) => String::new(),
        Some(many) => format!(" with {many} in flight"),
    };
    let eyes = scene.stereo.map_or_else(String::new, |stereo| {
        format!(
            " (eyes {} m apart, converging at {} m)",
            format::metres(stereo.interocular),
            format::metres(stereo.convergence)
        )
    });
    let motion = scene
        .motion
        .as_ref()
        .map_or_else(String::new, motion::words);
    let noise = match report.noise.frame_time_ratio_p95 {
        Some(ratio) => format!("noise {} %", format::percent((ratio - 1.0) * 100.0)),
        None => "noise not measured".to_owned(),
    };
    let missing = scene.left_out.iter().map(|parts| {
        let MissingParts {
            part,
            count,
            reason,
        } = parts;
        let number = format::count(*count as f64);
        format!(
            "{number} {} ({})",
            format::clean(part),
            format::clean(reason)
        )
    });
    let missing = match missing.collect::<Vec<_>>().join(", ") {
        none if none.is_empty() => none,
        parts => format!("; left out of its file: {parts}"),
    };
    let owned = scene.owned_percent.map_or_else(String::new, |percent| {
        format!(
            "; entities own {} % of the pixels",
            format::percent(percent)
        )
    });
    [
        format!(
            "scene {}: {}, {}; {width} x {height} pixels{samples}, {}{eyes}, {}{in_flight}{path}{motion}{owned}{missing}",
            format::clean(&scene.name),
            format::plural(scene.entities, "entity"),
            format::plural(scene.triangles, "triangle"),
            format::plural(u64::from(scene.views), "view"),
            format::plural(scene.frames, "frame"),
        ),
        format!(
            "adapter {} ({}, {}); {noise}",
            format::clean(&report.adapter.name),
            format::clean(&report.adapter.backend),
            format::clean(&report.adapter.kind)
        ),
    ]
}
