//! `antumbra sweep`: what it tries, what it writes and says, and what it refuses.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::path::Path;

use antumbra::measure::report::Report;
use antumbra::measure::trade_off;
use common::{refuses, succeeds};

/// A sweep of a small grid; `asked` are further arguments.
fn sweep(out: &Path, asked: &[&str]) -> String {
    let arguments = [
        "sweep",
        "grid:4",
        "--size",
        "64x64",
        "--frames",
        "4",
        "--out",
        out.to_str().unwrap(),
    ];
    succeeds(&[&arguments[..], asked].concat())
}

#[test]
fn all_settings_run_in_one_comparison_and_land_in_one_report() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    let said = sweep(
        &out,
        &[
            "--strategy",
            "three-pass",
            "--vary",
            "threshold=0..100*10",
            "--vary",
            "latency=on-gpu,same-frame",
            "--set",
            "three-pass.scale=1",
            "--limit",
            "wrong_pixels=0.5%",
            "--budget",
            "wrong_pixels=0",
        ],
    );
    for words in [
        "sweep of three-pass over threshold = 0, 1, 10, 100; latency = on-gpu, same-frame",
        "threshold=10 latency=on-gpu",
        "efficient",
        // The spheres own 29 % of these pixels.
        "at most 0.50 % of the pixels that entities own wrong on average",
        "at most 0.50 % of the pixels that entities own wrong in the worst frame",
        "no wrong pixel",
        "report.html",
        "trade.svg",
    ] {
        assert!(said.contains(words), "'{words}' is not in: {said}");
    }
    let report = Report::load(out.join("report.json")).unwrap();
    let titles: Vec<&str> = report.strategies.iter().map(|s| s.title()).collect();
    assert_eq!(titles.len(), 3 + 8);
    assert_eq!(titles[..3], ["none", "frustum", "ideal"]);
    assert_eq!(titles[3], "three-pass threshold=0 latency=on-gpu");
    assert_eq!(titles[10], "three-pass threshold=100 latency=same-frame");
    for setting in &report.strategies[3..] {
        assert_eq!(setting.settings["scale"], 1);
        assert!(setting.time_vs_frustum.is_some() && setting.time_vs_ideal.is_some());
        let threshold = format!("threshold={} ", setting.settings["threshold"]);
        assert!(setting.title().contains(&threshold), "{}", setting.title());
    }
    // What the report says of the sweep is what the library finds in the report.
    let sweep = report.sweep.clone().unwrap();
    let budgets = ["wrong_pixels=0.5%", "wrong_pixels=0"].map(|text| text.parse().unwrap());
    let again = trade_off::sweep(
        &report,
        sweep.strategies.clone(),
        sweep.vary.clone(),
        &budgets,
    );
    assert_eq!(sweep, again);
    assert!(!sweep.edge.is_empty());
    let svg = std::fs::read_to_string(out.join("trade.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.contains("limit 0.50 %"));
    let html = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(html.contains("efficient edge") && html.contains("Sweep of three-pass"));
}

#[test]
fn several_strategies_share_what_is_varied_or_have_it_alone() {
    let dir = tempfile::tempdir().unwrap();
    let said = sweep(
        dir.path(),
        &[
            "--strategy",
            "coherent,stereo-coherent:latency=same-frame",
            "--vary",
            "fraction=0.5..1+0.5",
            "--vary",
            "coherent.latency=frame-late",
            "--stereo",
            "--quiet",
        ],
    );
    assert!(said.is_empty(), "{said}");
    let report = Report::load(dir.path().join("report.json")).unwrap();
    let titles: Vec<&str> = report.strategies[3..].iter().map(|s| s.title()).collect();
    assert_eq!(
        titles,
        [
            "coherent fraction=0.5 latency=frame-late",
            "coherent fraction=1 latency=frame-late",
            "stereo-coherent:latency=same-frame fraction=0.5",
            "stereo-coherent:latency=same-frame fraction=1",
        ]
    );
    assert_eq!(report.scene.views, 2);
    assert!(report.sweep.unwrap().budgets.is_empty());
}

#[test]
fn wrong_words_are_refused_with_what_there_is() {
    let refused = |asked: &[&str], words: &[&str]| {
        refuses(&[&["sweep", "grid:2"], asked].concat(), 2, words);
    };
    let three = ["--strategy", "three-pass", "--vary"];
    let vary = |vary: &str, words: &[&str]| refused(&[&three[..], &[vary]].concat(), words);
    vary("colour=red", &["colour", "threshold", "latency"]);
    vary("threshold=1,-1", &["-1", "0 to 1000000"]);
    vary("threshold", &["threshold", "KEY=V1,V2"]);
    vary("threshold=1,,2", &["threshold=1,,2", "KEY=V1,V2"]);
    vary("threshold=9..1", &["9..1", "1..256*4"]);
    vary("threshold=0..1000", &["0..1000", "200"]);
    vary("coherent.fraction=1", &["coherent.fraction", "three-pass"]);
    refused(
        &[&three[..], &["threshold=1", "--vary", "threshold=2"]].concat(),
        &["threshold", "twice"],
    );
    refused(
        &[&three[..], &["threshold=0..99", "--vary", "coarser=0..9"]].concat(),
        &["1000", "200"],
    );
    refused(
        &["--strategy", "magic", "--vary", "a=1"],
        &["magic", "three-pass"],
    );
    refused(
        &["--strategy", "frustum", "--vary", "a=1"],
        &["frustum", "'a'", "none"],
    );
    refused(&["--strategy", "three-pass"], &["--vary"]);
    refused(&["--vary", "threshold=1"], &["--strategy"]);
    refused(
        &[&three[..], &["threshold=1", "--set", "threshold=1"]].concat(),
        &["STRATEGY.KEY=VALUE"],
    );
    let budget = |budget: &str| {
        let asked = [&three[..], &["threshold=1", "--limit", budget]].concat();
        refused(&asked, &[budget, "wrong_pixels=0.05%"]);
    };
    budget("wrong_pixels=0.05");
    budget("wrong_pixels=200%");
    budget("0.05%");
    budget("flip=3");
}
