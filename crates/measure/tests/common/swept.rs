//! A synthetic sweep whose Pareto front and choices are known.

use antumbra_measure::report::{Report, StrategyReport, VariedSetting};
use antumbra_measure::trade_off::{self, ErrorLimit};

use crate::synthetic;

/// A setting of `three-pass` that takes `time` times as long as frustum in each of twelve frames, with
/// `mean` percent of wrong pixels and twice as many in the worst frame.
pub fn setting(threshold: &str, time: f64, mean: f64) -> StrategyReport {
    let mut setting = synthetic::strategy("three-pass", "frame-late", 1.0, 0.1, 0.0, 700.0);
    setting.label = format!("three-pass threshold={threshold}");
    setting.frame_ms.median = 100.0 * time;
    setting.time_vs_frustum = Some(time);
    setting.frames.frame_ms = vec![100.0 * time; 12];
    setting.frames.wrong_pixels_percent = vec![mean; 12];
    setting.error.wrong_pixels_percent.mean = mean;
    setting.error.wrong_pixels_percent.max = 2.0 * mean;
    setting.error.flip.mean = mean / 100.0;
    setting.error.flip.max = mean / 50.0;
    setting.error.false_culls.entities = (mean * 1000.0) as u64;
    setting
}

/// A report of these settings beside the yardsticks, with 5 % of noise and blocks of two frames.
pub fn report(settings: Vec<StrategyReport>) -> Report {
    let mut report = synthetic::report();
    report.strategies.truncate(3);
    for yardstick in &mut report.strategies {
        yardstick.frames.frame_ms.truncate(12);
    }
    report.strategies.extend(settings);
    report.scene.frames = 12;
    report.noise.frame_time_ratio_p95 = Some(1.05);
    report.noise.block_frames = Some(2);
    report
}

/// A report with a known Pareto front: `0`, `4` and `64`. `5` is faster than `4`, but only within the noise; `64` dominates `99`.
pub fn known() -> Report {
    report(vec![
        setting("99", 0.35, 0.3),
        setting("0", 0.50, 0.0),
        setting("4", 0.40, 0.01),
        setting("5", 0.39, 0.02),
        setting("64", 0.30, 0.2),
    ])
}

/// The report as a sweep with these limits.
pub fn with(mut report: Report, budgets: &[&str]) -> Report {
    let limits: Vec<ErrorLimit> = budgets.iter().map(|text| text.parse().unwrap()).collect();
    let values = ["99", "0", "4", "5", "64"].map(str::to_owned);
    let vary = VariedSetting {
        strategy: None,
        key: "threshold".into(),
        values: values.into(),
    };
    let sweep = trade_off::sweep(&report, vec!["three-pass".into()], vec![vary], &limits);
    report.sweep = Some(sweep);
    report
}
