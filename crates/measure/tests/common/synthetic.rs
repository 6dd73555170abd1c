//! A synthetic report with plausible numbers: four strategies and the three yardsticks, on a software adapter.

use std::collections::BTreeMap;

use antumbra_measure::report::{
    Adapter, Drawn, ErrorReport, FalseCulls, FrameSeries, MeanMax, Noise, PassTime, PoseRecord,
    Report, SceneFacts, Spread, StrategyReport, WorstFrame, WorstImages,
};
use antumbra_measure::stats::{mean, median, percentile};
use serde_json::json;

const FRAMES: usize = 240;

/// The whole report; its pictures are drawn by `pictures.rs`.
pub fn report() -> Report {
    let strategies = vec![
        strategy("none", "none", 31.0, 0.4, 0.0, 20_000.0),
        strategy("frustum", "none", 14.2, 0.9, 0.0, 8_420.0),
        strategy("ideal", "none", 2.9, 0.0, 0.0, 612.0),
        strategy("hi-z", "on-gpu", 5.6, 1.7, 0.0, 1_030.0),
        strategy("three-pass", "frame-late", 4.2, 1.1, 0.012, 688.0),
        strategy("id-histogram", "frame-late", 4.4, 1.3, 0.018, 671.0),
        strategy("coherent-queries", "same-frame", 8.9, 4.6, 0.0, 905.0),
    ];
    Report {
        antumbra: "0.1.0".into(),
        command: "antumbra compare grid --frames 240 --size 960x540".into(),
        adapter: Adapter {
            name: "llvmpipe (LLVM 15.0.6, 256 bits)".into(),
            backend: "vulkan".into(),
            kind: "cpu".into(),
        },
        scene: SceneFacts {
            name: "grid".into(),
            path: "orbit".into(),
            entities: 20_000,
            triangles: 15_360_000,
            views: 1,
            stereo: None,
            samples: 1,
            in_flight: Some(1),
            size: [960, 540],
            frames: FRAMES as u64,
            owned_percent: None,
            left_out: Vec::new(),
            motion: None,
        },
        noise: Noise {
            frame_time_ratio_p95: Some(1.013),
            block_frames: Some(20),
        },
        labels: BTreeMap::from([("driver".into(), "Mesa 22.3.6".into())]),
        seeds: BTreeMap::from([("path".into(), 7), ("rotation".into(), 11)]),
        poses: vec![PoseRecord {
            position: [0.0, 10.0, 40.0],
            rotation: [0.0, 0.0, 0.0, 1.0],
            cut: true,
        }],
        strategies,
        sweep: None,
    }
}

/// A strategy whose frames take about `ms`, of which `cull` is culling, with `wrong` percent wrong pixels on average.
pub fn strategy(
    name: &str,
    latency: &str,
    ms: f64,
    cull: f64,
    wrong: f64,
    drawn: f64,
) -> StrategyReport {
    let salt = name.len() as f64;
    let frame_ms: Vec<f64> = (0..FRAMES)
        .map(|i| {
            let turn = i as f64 * 0.02;
            let jitter = ((i as f64 * 12.9898 + salt).sin() * 43_758.545_3)
                .fract()
                .abs();
            ms * (1.0
                + 0.25 * (2.0 * turn + 0.1 * salt).sin() * (1.0 - drawn / 20_000.0)
                + 0.05 * jitter)
        })
        .collect();
    let wrong_series: Vec<f64> = (0..FRAMES)
        .map(|i| wrong * if i % 9 == 4 { 6.0 } else { 0.375 })
        .collect();
    let middle = median(&frame_ms).unwrap();
    let error = ErrorReport {
        wrong_pixels_percent: MeanMax {
            mean: mean(&wrong_series).unwrap(),
            max: percentile(&wrong_series, 100.0).unwrap(),
        },
        false_culls: FalseCulls {
            entities: (wrong * 4000.0) as u64,
            worst_frame: (wrong > 0.0).then_some(4),
            longest_run_frames: u64::from(wrong > 0.0) * 3,
        },
        flip: MeanMax {
            mean: wrong * 0.02,
            max: wrong * 0.09,
        },
        ..ErrorReport::default()
    };
    let pass = |name: &str, group: &str, ms: f64| PassTime {
        name: name.into(),
        group: group.into(),
        cpu_ms: Some(0.02 + ms * 0.01),
        gpu_ms: Some(ms),
    };
    StrategyReport {
        name: name.into(),
        latency: latency.into(),
        settings: BTreeMap::from([("threshold".into(), json!(4)), ("scale".into(), json!(0.5))]),
        conservative: wrong == 0.0,
        frame_ms: Spread {
            median: middle,
            p95: percentile(&frame_ms, 95.0).unwrap(),
        },
        free_running_ms: Some(middle * 0.9),
        cull_ms: Some(cull),
        draw_ms: Some((middle - cull) * 0.85),
        time_vs_none: Some(ms / 31.0),
        time_vs_frustum: Some(ms / 14.2),
        time_vs_ideal: Some(ms / 2.9),
        drawn: Drawn {
            entities: drawn,
            triangles: drawn * 768.0,
        },
        queries: if latency == "none" { 0.0 } else { 8_420.0 },
        sync_points: u32::from(latency == "same-frame"),
        overdrawn_entities: (drawn - 612.0).max(0.0),
        error,
        views: Vec::new(),
        frames: FrameSeries {
            frame_ms,
            wrong_pixels_percent: wrong_series,
            ..FrameSeries::default()
        },
        passes: vec![
            pass("occluder depth", "cull", cull * 0.4),
            pass("visible samples", "cull", cull * 0.6),
            pass("shaded", "draw", (middle - cull) * 0.85),
        ],
        verdicts: BTreeMap::from([
            ("visible".into(), drawn),
            ("occluded".into(), 8_420.0 - drawn.min(8_420.0)),
        ]),
        worst: (wrong > 0.0).then(|| WorstFrame {
            frame: 4,
            view: 0,
            images: WorstImages {
                reference: format!("images/{name}-reference.png"),
                strategy: format!("images/{name}-frame.png"),
                marked: format!("images/{name}-marked.png"),
            },
        }),
        ..StrategyReport::default()
    }
}
