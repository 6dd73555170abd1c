//! Sentences about audits and budgets.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "common/synthetic.rs"]
mod synthetic;

use antumbra_measure::audit_summary::audit_summaries;
use antumbra_measure::report::{AuditReport, BudgetReport, FrameSeries, StrategyReport};

fn strategy(label: &str, frame_ms: f64) -> StrategyReport {
    StrategyReport {
        name: "three-pass".to_owned(),
        label: label.to_owned(),
        frames: FrameSeries {
            frame_ms: vec![frame_ms; 4],
            ..FrameSeries::default()
        },
        ..StrategyReport::default()
    }
}

#[test]
fn an_audit_is_held_against_the_truth_and_its_cost_against_the_same_without() {
    let mut report = synthetic::report();
    let mut audited = strategy("late audited", 10.2);
    audited.error.wrong_pixels_percent.mean = 0.04;
    audited.audit = Some(AuditReport {
        frames: 200,
        percent: 0.05,
        low: 0.02,
        high: 0.1,
        frames_within: 198,
        ..AuditReport::default()
    });
    report.strategies = vec![strategy("late", 10.0), audited];
    let all = audit_summaries(&report);
    let [only] = all.as_slice() else {
        panic!("{all:?}");
    };
    assert_eq!(only.strategy.label, "late audited");
    // Old reports mark an audited entry only by its audit block.
    assert!(!only.strategy.audited);
    let text = only.lines.join("; ");
    for part in [
        "by its own audit 0.050 %",
        "(0.020 to 0.10)",
        "in truth 0.040 %",
        "99 % held",
        "takes 2.0 %",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn the_entry_without_an_audit_is_found_by_settings_and_not_by_title() {
    let mut report = synthetic::report();
    let with = |label: &str, threshold: u32| {
        let mut strategy = strategy(label, 10.0);
        let settings = [("threshold".to_owned(), threshold.into())];
        strategy.settings = settings.into();
        strategy
    };
    let mut audited = with("any title", 2);
    audited.audited = true;
    let mut within = with("with a budget", 2);
    within.audited = true;
    within.budget = Some(BudgetReport {
        asked: "wrong_pixels=0.02%".to_owned(),
        ..BudgetReport::default()
    });
    report.strategies = vec![with("one", 1), audited, within, with("two", 2)];
    let found = |at: usize| {
        let plain = report.without_audit(&report.strategies[at]);
        plain.map(StrategyReport::title)
    };
    assert_eq!([0, 1, 2, 3].map(found), [None, Some("two"), None, None]);
}

#[test]
fn a_budget_says_whether_it_was_kept_and_where_frames_stood() {
    let mut report = synthetic::report();
    let within = |mean: f64, kept| {
        let mut strategy = strategy("late within wrong_pixels=0.02%", 10.0);
        strategy.error.wrong_pixels_percent.mean = mean;
        strategy.budget = Some(BudgetReport {
            asked: "wrong_pixels=0.02%".to_owned(),
            kept: Some(kept),
            kept_of_owned: None,
            frames_a_step: vec![3, 0, 21],
            allowed_percent: 0.01,
        });
        strategy
    };
    let fixed = |label: &str, mean: f64, frame_ms: f64| {
        let mut strategy = strategy(label, frame_ms);
        strategy.error.wrong_pixels_percent.mean = mean;
        strategy
    };
    let mut waits = fixed("waits", 0.0, 5.0);
    waits.latency = "same-frame".to_owned();
    report.strategies = vec![
        within(0.015, true),
        within(0.03, false),
        fixed("exact", 0.0, 12.0),
        fixed("good", 0.02, 9.0),
        fixed("fast", 0.021, 8.0),
        waits,
    ];
    let all = audit_summaries(&report);
    assert_eq!(all.len(), 2, "{all:?}");
    let texts: Vec<String> = all.iter().map(|summary| summary.lines.join("; ")).collect();
    assert!(
        texts[0].contains("kept with 0.015 %") && texts[0].contains("3, 0, 21"),
        "{texts:?}"
    );
    assert!(
        texts[0].contains("90 % of the speed of good") && texts[0].contains("(+- 0,"),
        "{texts:?}"
    );
    assert!(texts[1].contains("overdrawn with 0.030 %"), "{texts:?}");
}
