//! `antumbra compare` with audits and budgets: what is run beside what, what the report holds, and what is refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra::measure::report::{Report, StrategyReport};
use common::{refuses, succeeds};

fn compared(asked: &[&str]) -> (String, Report) {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    let arguments = [
        "compare",
        "grid:6",
        "--size",
        "96x64",
        "--frames",
        "8",
        "--out",
        out.to_str().unwrap(),
    ];
    let said = succeeds(&[&arguments[..], asked].concat());
    (said, Report::load(out.join("report.json")).unwrap())
}

fn entry<'a>(report: &'a Report, title: &str) -> &'a StrategyReport {
    let mut all = report.strategies.iter();
    let found = all.find(|one| one.title() == title);
    found.unwrap_or_else(|| panic!("'{title}' is not in the report"))
}

#[test]
fn an_audited_strategy_runs_beside_the_same_without() {
    let (said, report) = compared(&["--strategies", "frustum,three-pass", "--audit=0.5"]);
    let titles: Vec<&str> = report.strategies.iter().map(|one| one.title()).collect();
    assert_eq!(titles, ["frustum", "three-pass", "three-pass audited"]);
    let audited = entry(&report, "three-pass audited");
    let audit = audited.audit.as_ref().unwrap();
    // Seven of eight answers at least have come; the last is still under way.
    assert!((7..=8).contains(&audit.frames), "{audit:?}");
    assert!(audit.frames_within <= audit.frames && audit.low <= audit.percent);
    assert!(audit.percent <= audit.high && audited.audit_ms.is_some());
    let plain = entry(&report, "three-pass");
    assert!(plain.audit.is_none() && plain.audit_ms.is_none());
    assert_eq!(plain.error, audited.error, "an audit changes what is drawn");
    for words in ["by its own audit", "the audit takes"] {
        assert!(said.contains(words), "'{words}' is not in: {said}");
    }
}

#[test]
fn a_budget_of_nothing_gets_nothing_wrong_and_says_so() {
    let (said, report) = compared(&[
        "--strategies",
        "three-pass,stop-and-wait",
        "--budget",
        "wrong_pixels=0%",
        "--budget",
        "frame_time=50ms",
    ]);
    let exact = entry(&report, "three-pass within wrong_pixels=0%");
    assert_eq!(exact.error.wrong_pixels_percent.max, 0.0);
    assert!(exact.conservative);
    let budget = exact.budget.as_ref().unwrap();
    assert_eq!(
        (budget.kept, budget.frames_a_step.as_slice()),
        (Some(true), &[8][..])
    );
    let timed = entry(&report, "three-pass within frame_time=50ms");
    assert_eq!(timed.budget.as_ref().unwrap().kept, None);
    // What has nothing to trade is left as it is.
    assert_eq!(report.strategies.len(), 4);
    assert!(said.contains("wrong_pixels=0%: kept with 0 %"), "{said}");
}

#[test]
fn a_budget_without_a_unit_is_wrong_usage() {
    let asked = |budget| ["compare", "grid:4", "--budget", budget];
    refuses(&asked("wrong_pixels=0.02"), 2, &["wrong_pixels=0.02%"]);
    refuses(&asked("time=3"), 2, &["frame_time=16.6ms"]);
    refuses(&["compare", "grid:4", "--audit=0"], 2, &["above 0"]);
}
