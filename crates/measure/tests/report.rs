//! `report.json`: its published names, writing and reading, and what it refuses.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "common/swept.rs"]
mod swept;
#[path = "common/synthetic.rs"]
mod synthetic;

use std::path::{Path, PathBuf};

use antumbra_measure::MeasureError;
use antumbra_measure::report::{MAX_REPORT_BYTES, Report};
use serde_json::{Value, json};

fn refused(change: impl FnOnce(&mut Report)) -> String {
    let mut report = synthetic::report();
    change(&mut report);
    report.to_json().unwrap_err().to_string()
}

/// The reports below `docs/reports`, of any age.
fn published(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            published(&path, found);
        } else if path
            .extension()
            .is_some_and(|extension| extension == "json")
        {
            found.push(path);
        }
    }
}

#[test]
fn published_reports_are_still_read() {
    let mut found = Vec::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    published(&root.join("../../docs/reports"), &mut found);
    assert!(found.len() > 20, "{found:?}");
    for path in found {
        let report = Report::load(&path).unwrap_or_else(|error| panic!("{error}"));
        // Entries of before the field are known as audited by their audit.
        for strategy in &report.strategies {
            let plain = report.without_audit(strategy);
            assert!(plain.is_none_or(|plain| plain.audit.is_none() && plain.budget.is_none()));
        }
    }
}

#[test]
fn published_fields_keep_their_names() {
    let value: Value = serde_json::from_str(&synthetic::report().to_json().unwrap()).unwrap();
    for pointer in [
        "/antumbra",
        "/adapter/name",
        "/adapter/backend",
        "/adapter/type",
        "/scene/name",
        "/scene/entities",
        "/scene/triangles",
        "/scene/views",
        "/scene/size/1",
        "/scene/frames",
        "/scene/path",
        "/noise/frame_time_ratio_p95",
        "/command",
        "/labels/driver",
        "/seeds/path",
        "/poses/0/position/2",
        "/poses/0/rotation/3",
        "/poses/0/cut",
        "/strategies/4/name",
        "/strategies/4/latency",
        "/strategies/4/settings/threshold",
        "/strategies/4/conservative",
        "/strategies/4/frame_ms/median",
        "/strategies/4/frame_ms/p95",
        "/strategies/4/free_running_ms",
        "/strategies/4/cull_ms",
        "/strategies/4/draw_ms",
        "/strategies/4/time_vs_none",
        "/strategies/4/time_vs_frustum",
        "/strategies/4/time_vs_ideal",
        "/strategies/4/drawn/entities",
        "/strategies/4/drawn/triangles",
        "/strategies/4/queries",
        "/strategies/4/sync_points",
        "/strategies/4/overdrawn_entities",
        "/strategies/4/error/wrong_pixels_percent/mean",
        "/strategies/4/error/wrong_pixels_percent/max",
        "/strategies/4/error/false_culls/entities",
        "/strategies/4/error/false_culls/worst_frame",
        "/strategies/4/error/false_culls/longest_run_frames",
        "/strategies/4/error/flip/mean",
        "/strategies/4/error/flip/max",
        "/strategies/4/views",
        "/strategies/4/frames/frame_ms/0",
        "/strategies/4/frames/wrong_pixels_percent/0",
        "/strategies/4/passes/0/name",
        "/strategies/4/passes/0/group",
        "/strategies/4/passes/0/cpu_ms",
        "/strategies/4/passes/0/gpu_ms",
        "/strategies/4/verdicts/visible",
        "/strategies/4/worst/frame",
        "/strategies/4/worst/view",
        "/strategies/4/worst/images/reference",
        "/strategies/4/worst/images/strategy",
        "/strategies/4/worst/images/marked",
    ] {
        assert!(
            value.pointer(pointer).is_some_and(|v| !v.is_null()),
            "{pointer} is missing"
        );
    }
}

#[test]
fn a_saved_report_comes_back_and_nothing_is_left_beside_it() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("report.json");
    let report = synthetic::report();
    report.save(&file).unwrap();
    report.save(&file).unwrap();
    assert_eq!(Report::load(&file).unwrap(), report);
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1);
}

#[test]
fn a_failed_save_leaves_the_old_report_alone() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("report.json");
    let mut report = synthetic::report();
    report.save(&file).unwrap();
    let before = std::fs::read(&file).unwrap();
    report.strategies[0].queries = f64::NAN;
    report.save(&file).unwrap_err();
    assert_eq!(std::fs::read(&file).unwrap(), before);
    // A folder has the name of the file: the rename fails, and the temporary file is removed.
    let taken = dir.path().join("taken");
    std::fs::create_dir(&taken).unwrap();
    let error = synthetic::report().save(&taken).unwrap_err();
    assert!(matches!(error, MeasureError::File { .. }), "{error}");
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 2);
}

#[test]
fn fields_of_later_versions_are_skipped_and_added_ones_may_be_missing() {
    let mut value = serde_json::to_value(synthetic::report()).unwrap();
    value["invented_later"] = json!({ "any": [1, null] });
    value["strategies"][0]["invented_later"] = json!("x");
    for field in ["command", "labels", "seeds", "poses"] {
        value.as_object_mut().unwrap().remove(field);
    }
    for field in [
        "frames",
        "passes",
        "worst",
        "verdicts",
        "views",
        "cull_ms",
        "time_vs_ideal",
    ] {
        value["strategies"][4]
            .as_object_mut()
            .unwrap()
            .remove(field);
    }
    value["strategies"][5]["draw_ms"] = Value::Null;
    let report: Report = serde_json::from_value(value).unwrap();
    report.check().unwrap();
    assert_eq!(report.strategies[4].cull_ms, None);
    assert_eq!(report.strategies[5].draw_ms, None);
}

#[test]
fn no_number_that_is_none_is_written_and_its_field_is_named() {
    for (field, words) in [
        (
            refused(|r| r.strategies[2].frame_ms.median = f64::NAN),
            "strategies[2].frame_ms.median",
        ),
        (
            refused(|r| r.strategies[1].cull_ms = Some(f64::INFINITY)),
            "strategies[1].cull_ms",
        ),
        (
            refused(|r| r.noise.frame_time_ratio_p95 = Some(f64::NAN)),
            "noise.frame_time_ratio_p95",
        ),
        (
            refused(|r| r.strategies[0].frames.frame_ms[7] = f64::NAN),
            "strategies[0].frames.frame_ms[7]",
        ),
        (
            refused(|r| r.strategies[0].passes[1].gpu_ms = Some(f64::NAN)),
            "strategies[0].passes[1].gpu_ms",
        ),
        (
            refused(|r| r.poses[0].position[1] = f64::NAN),
            "poses[0].position[1]",
        ),
        (
            refused(|r| {
                r.strategies[0]
                    .verdicts
                    .extend([("new".to_owned(), f64::NAN)])
            }),
            "strategies[0].verdicts.new",
        ),
    ] {
        assert!(field.contains(words) && field.contains("finite"), "{field}");
    }
    // Settings are free-form, so null is a value there.
    let mut report = synthetic::report();
    report.strategies[0]
        .settings
        .insert("limit".into(), Value::Null);
    report.to_json().unwrap();
}

#[test]
fn pictures_outside_the_folder_are_refused() {
    for file in [
        "../secret.png",
        "/etc/passwd",
        "a/../../b.png",
        "",
        "C:\\x.png",
        "\\host\\x.png",
        "./x.png",
    ] {
        let text =
            refused(|r| r.strategies[4].worst.as_mut().unwrap().images.marked = file.to_owned());
        assert!(
            text.contains("strategies[4].worst.images.marked"),
            "{file}: {text}"
        );
    }
    assert!(refused(|r| r.scene.size = [0, 4]).contains("scene.size"));
}

#[test]
fn hostile_files_give_errors() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("report.json");
    let load = |bytes: &[u8]| {
        std::fs::write(&file, bytes).unwrap();
        Report::load(&file).unwrap_err().to_string()
    };
    let good = synthetic::report().to_json().unwrap();
    assert!(load(&good.as_bytes()[..good.len() / 2]).contains("report.json"));
    let deep = good.replacen(
        "\"threshold\": 4",
        &format!("\"threshold\": {}", "[".repeat(100_000)),
        1,
    );
    assert!(load(deep.as_bytes()).contains("recursion"));
    assert!(load(b"\xff\xfe").contains("report.json"));
    assert!(load(b"{}").contains("antumbra"));
    assert!(
        load(
            good.replacen("\"queries\": ", "\"queries\": 1e999, \"x\": ", 1)
                .as_bytes()
        )
        .contains("out of range")
    );
    std::fs::File::create(&file)
        .unwrap()
        .set_len(MAX_REPORT_BYTES + 1)
        .unwrap();
    assert!(
        Report::load(&file)
            .unwrap_err()
            .to_string()
            .contains("larger than")
    );
    assert!(
        Report::load(dir.path().join("none"))
            .unwrap_err()
            .to_string()
            .contains("none")
    );
}

#[test]
fn efficiency_is_the_share_of_ideal() {
    let report = synthetic::report();
    assert_eq!(report.strategy("ideal").unwrap().efficiency(), Some(1.0));
    let three = report.strategy("three-pass").unwrap();
    assert!((three.efficiency().unwrap() - 2.9 / 4.2).abs() < 1e-12);
    assert!(report.strategy("no such").is_none());
    assert!(!three.breaks_its_promise());
}

#[test]
fn a_sweep_keeps_its_names_and_comes_back() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("report.json");
    let report = swept::with(swept::known(), &["wrong_pixels=0.05%", "false_culls=3"]);
    report.save(&file).unwrap();
    assert_eq!(Report::load(&file).unwrap(), report);
    let value: Value = serde_json::from_str(&report.to_json().unwrap()).unwrap();
    assert_eq!(value["noise"]["block_frames"], 2);
    let sweep = &value["sweep"];
    assert_eq!(sweep["strategies"], json!(["three-pass"]));
    assert_eq!(sweep["vary"][0]["key"], "threshold");
    assert_eq!(sweep["vary"][0]["values"][1], "0");
    assert_eq!(sweep["edge"][0], "three-pass threshold=0");
    assert_eq!(sweep["budgets"][0]["measure"], "wrong_pixels_percent");
    assert_eq!(sweep["budgets"][0]["limit"], 0.05);
    assert_eq!(sweep["budgets"][1]["measure"], "false_culls");
    let choices = &sweep["budgets"][0]["choices"];
    assert_eq!(
        (&choices[0]["over"], &choices[1]["over"]),
        (&json!("mean"), &json!("max"))
    );
    assert_eq!(choices[0]["setting"], "three-pass threshold=4");
    assert_eq!(choices[0]["within"], true);
    for field in ["error", "margin", "fastest", "alike"] {
        assert!(!choices[0][field].is_null(), "{field}");
    }
    for field in [
        "setting",
        "time_ratio",
        "slower_blocks",
        "blocks",
        "by_chance",
    ] {
        assert!(!choices[0]["next"][field].is_null(), "{field}");
    }
    // Tables leave out the part of the title that all settings of one strategy share.
    assert_eq!(report.title_of(&report.strategies[4]), "threshold=0");
    assert_eq!(report.title_of(&report.strategies[0]), "none");
}

#[test]
fn reports_of_before_there_were_sweeps_are_read() {
    let mut value = serde_json::to_value(synthetic::report()).unwrap();
    assert!(value.get("sweep").is_none());
    value["noise"]
        .as_object_mut()
        .unwrap()
        .remove("block_frames");
    let report: Report = serde_json::from_value(value).unwrap();
    report.check().unwrap();
    assert_eq!((report.sweep, report.noise.block_frames), (None, None));
}

#[test]
fn a_sweep_that_names_no_setting_is_refused() {
    let good = || swept::with(swept::known(), &["wrong_pixels=0.05%"]);
    let refused = |change: fn(&mut antumbra_measure::report::Sweep)| {
        let mut report = good();
        change(report.sweep.as_mut().unwrap());
        report.check().unwrap_err().to_string()
    };
    for text in [
        refused(|s| s.budgets[0].choices[1].setting = "ghost".into()),
        refused(|s| s.budgets[0].choices[1].alike = vec!["ghost".into()]),
        refused(|s| s.budgets[0].choices[1].fastest = Some("ghost".into())),
    ] {
        assert!(
            text.contains("sweep.budgets[0].choices[1]") && text.contains("ghost"),
            "{text}"
        );
    }
    assert!(refused(|s| s.edge[2] = "ghost".into()).contains("sweep.edge[2]"));
    assert!(refused(|s| s.budgets[0].limit = f64::NAN).contains("sweep.budgets[0].limit"));
}
