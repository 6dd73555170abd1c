//! Faults around a run: results survive a late one, runs into one folder exclude each other, and the end of a run leaves whole files or none.
#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::fs::{self, File, OpenOptions};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Child, Command, Output};
use std::time::Duration;

use common::{antumbra, names, program, refuses, stderr, succeeds};

/// A comparison that takes a second or two.
const SMALL: [&str; 8] = [
    "compare",
    "grid:3",
    "--strategies",
    "frustum",
    "--frames",
    "2",
    "--size",
    "64x48",
];

fn text(path: &Path) -> String {
    path.to_str().unwrap().to_owned()
}

fn into(out: &Path) -> Vec<String> {
    let mut words: Vec<String> = SMALL.map(str::to_owned).to_vec();
    words.extend(["--out".to_owned(), text(out)]);
    words
}

fn words(list: &[String]) -> Vec<&str> {
    list.iter().map(String::as_str).collect()
}

/// The lock of a folder, as a run holds it.
fn hold(folder: &Path) -> File {
    fs::create_dir_all(folder).unwrap();
    let mut options = OpenOptions::new();
    let lock = options.write(true).create(true).truncate(false);
    let lock = lock.open(folder.join(".antumbra.lock")).unwrap();
    lock.lock().unwrap();
    lock
}

#[test]
fn two_runs_into_one_folder_exclude_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let held = hold(&out);
    refuses(&words(&into(&out)), 1, &["another run", &text(&out)]);
    let sweep = ["--strategy", "three-pass", "--vary", "threshold=1"];
    let sweep = [
        &["sweep", "grid:3"],
        &sweep[..],
        &["--out", out.to_str().unwrap()],
    ]
    .concat();
    refuses(&sweep, 1, &["another run"]);
    drop(held);
    succeeds(&words(&into(&out)));
    assert_eq!(names(&out), ["report.html", "report.json"]);
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_anything_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "a file").unwrap();
    // Named last, so that a scene that is loaded first would be complained of instead.
    let below = text(&file.join("out"));
    let missing = text(&folder.path().join("missing.glb"));
    refuses(&["compare", &missing, "--out", &below], 1, &[&below]);
    let image = text(&folder.path().join("no/folder.png"));
    refuses(&["render", &missing, "-o", &image], 1, &[&image]);
    let scene = text(&folder.path().join("no/folder.glb"));
    refuses(&["prepare", &missing, "-o", &scene], 1, &[&scene]);
}

#[test]
fn a_read_only_file_is_refused_and_the_mode_of_others_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let image = folder.path().join("image.png");
    fs::write(&image, "old").unwrap();
    let asked = text(&image);
    let asked = ["render", "grid:2", "--size", "32x24", "-o", &asked];
    fs::set_permissions(&image, fs::Permissions::from_mode(0o444)).unwrap();
    refuses(&asked, 1, &["image.png", "read-only"]);
    assert_eq!(fs::read(&image).unwrap(), b"old");
    fs::set_permissions(&image, fs::Permissions::from_mode(0o640)).unwrap();
    succeeds(&asked);
    let mode = fs::metadata(&image).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o640);
    assert_ne!(fs::read(&image).unwrap(), b"old");
}

#[test]
fn an_output_that_is_a_link_stays_one() {
    let folder = tempfile::tempdir().unwrap();
    let [link, file] = ["link.png", "file.png"].map(|name| folder.path().join(name));
    fs::write(&file, "old").unwrap();
    std::os::unix::fs::symlink("file.png", &link).unwrap();
    succeeds(&["render", "grid:2", "--size", "32x24", "-o", &text(&link)]);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert!(fs::read(&file).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn the_table_is_printed_even_if_saving_fails() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    // Found only when the page takes its place: a link that leads to a folder which is not there.
    std::os::unix::fs::symlink("gone/page.html", out.join("report.html")).unwrap();
    let output = antumbra(&words(&into(&out)));
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(printed.contains("frustum"), "{printed}");
    assert!(
        stderr(&output).contains("report.html"),
        "{}",
        stderr(&output)
    );
    // The page and the report appear together or not at all.
    assert_eq!(names(&out), ["report.html"]);
}

#[test]
fn a_closed_standard_output_costs_no_result() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut run = program(&words(&into(&out)));
    let mut run = run.spawn().unwrap();
    drop(run.stdout.take());
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stderr(&output), "");
    assert_eq!(names(&out), ["report.html", "report.json"]);
    let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = program(&words(&into(&out))).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("standard output"),
        "{}",
        stderr(&output)
    );
    assert_eq!(names(&out), ["report.html", "report.json"]);
}

#[test]
fn pictures_of_an_earlier_run_do_not_stay_behind() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let own = "three-pass:latency=same-frame:threshold=40";
    let sweep = [
        "sweep",
        "grid:5",
        "--size",
        "64x48",
        "--frames",
        "3",
        "--quiet",
        "--strategy",
        own,
        "--vary",
        "scale=0.5",
        "--out",
        out.to_str().unwrap(),
    ];
    succeeds(&sweep);
    let first = names(&out);
    assert!(
        first.iter().any(|name| name.ends_with("worst.png")),
        "{first:?}"
    );
    assert!(first.contains(&"trade.svg".to_owned()));
    fs::write(out.join("9-mine-worst.png"), "not ours").unwrap();
    succeeds(&words(&into(&out)));
    assert_eq!(
        names(&out),
        ["9-mine-worst.png", "report.html", "report.json"]
    );
}

#[test]
fn leftovers_of_a_killed_run_are_swept() {
    let folder = tempfile::tempdir().unwrap();
    let left = folder.path().join(".antumbra-AbCdEf012345.partial");
    let image = text(&folder.path().join("image.png"));
    fs::write(&left, "half").unwrap();
    succeeds(&["render", "grid:2", "--size", "32x24", "-o", &image]);
    assert_eq!(names(folder.path()), ["image.png"]);
    fs::write(&left, "half").unwrap();
    let volume = text(&folder.path().join("a.vol"));
    succeeds(&["prepare", "subsurface:20", "-o", &volume]);
    assert_eq!(names(folder.path()), ["a.vol", "image.png"]);
}

#[test]
fn a_fifo_where_a_file_should_be_is_not_waited_for() {
    let folder = tempfile::tempdir().unwrap();
    for name in [
        "a.glb", "a.gltf", "a.obj", "a.ply", "a.stl", "a.json", "a.npz", "a.asc", "a.tif", "a.gri",
        "a.ts", "a.csv", "a.roff", "a.vol", "path",
    ] {
        let fifo = folder.path().join(name);
        let made = Command::new("mkfifo").arg(&fifo).status().unwrap();
        assert!(made.success());
        let (fifo, out) = (text(&fifo), text(&folder.path().join("out.glb")));
        match name {
            "path" => refuses(
                &["graph", "grid:2", "--strategy", "frustum", "--path", &fifo],
                1,
                &["a FIFO"],
            ),
            "a.vol" => refuses(
                &[
                    "graph",
                    "grid:2",
                    "--strategy",
                    "frustum",
                    "--volume",
                    &fifo,
                ],
                1,
                &["a FIFO"],
            ),
            _ => refuses(&["prepare", &fifo, "-o", &out], 1, &[name, "a FIFO"]),
        }
    }
    // A file that a scene refers to.
    let scene = folder.path().join("b.gltf");
    fs::write(
        &scene,
        r#"{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "path"}]}"#,
    )
    .unwrap();
    let out = text(&folder.path().join("out.glb"));
    refuses(&["prepare", &text(&scene), "-o", &out], 1, &["a FIFO"]);
}

#[test]
fn names_out_of_files_reach_the_terminal_clean_and_cut() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("named.gltf");
    let long = "n".repeat(200_000);
    let hostile = r"\u001b]0;owned\u0007\u009b31m\u202e";
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "cameras": [{{"type": "perspective", "perspective": {{"yfov": 1, "znear": 0.1}}}}],
            "nodes": [{{"name": "{hostile}", "camera": 0}}, {{"name": "{long}", "camera": 0}}, {{"name": "{hostile}{long}", "children": [9]}}]}}"#
    );
    fs::write(&scene, json).unwrap();
    let asked = [
        "graph",
        &text(&scene),
        "--strategy",
        "frustum",
        "--path",
        "camera:none",
    ];
    let output = antumbra(&asked);
    let message = stderr(&output);
    assert!(message.contains("owned"), "{message}");
    assert!(message.len() < 10_000, "{} bytes", message.len());
    let hostile = |c: char| c != '\n' && (c.is_control() || c == '\u{202e}');
    assert!(!message.contains(hostile), "{message:?}");
}

#[test]
fn arguments_that_are_no_text_are_no_panic() {
    let folder = tempfile::tempdir().unwrap();
    let odd = std::ffi::OsStr::from_bytes(b"out-\xff");
    let mut run = program(&SMALL);
    let output = run
        .arg("--out")
        .arg(folder.path().join(odd))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let output = program(&["compare"]).arg(odd).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(!stderr(&output).contains("panicked"));
}

#[test]
fn a_recorded_command_can_be_typed_again() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("it's; $(touch owned)");
    succeeds(&words(&into(&out)));
    let report = fs::read_to_string(out.join("report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let command = report["command"].as_str().unwrap();
    let typed = shlex::split(command).unwrap();
    assert_eq!(typed[1..], words(&into(&out)), "{command}");
}

/// Starts a run that takes long, and waits until it has its folder.
fn started(out: &Path) -> Child {
    let asked = [
        "compare",
        "grid:6",
        "--frames",
        "2000",
        "--size",
        "64x48",
        "--out",
        out.to_str().unwrap(),
    ];
    let mut run = program(&asked).spawn().unwrap();
    while !out.join(".antumbra.lock").exists() {
        let status = run.try_wait().unwrap();
        assert!(status.is_none(), "it has ended before it had its folder");
        std::thread::sleep(Duration::from_millis(1));
    }
    run
}

fn signal(run: &Child, name: &str) {
    let id = run.id().to_string();
    let sent = Command::new("kill")
        .args(["-s", name, &id])
        .status()
        .unwrap();
    assert!(sent.success());
}

fn ended(run: Child) -> Output {
    run.wait_with_output().unwrap()
}

#[test]
fn a_signal_ends_a_run_with_words_and_leaves_no_file() {
    for (name, status) in [("INT", 130), ("TERM", 143)] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("deep/out");
        let run = started(&out);
        signal(&run, name);
        let output = ended(run);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(status), "{message}");
        assert!(
            message.contains(&format!("ended by SIG{name}")),
            "{message}"
        );
        assert!(message.contains("no file was written"), "{message}");
        assert!(
            names(folder.path()).is_empty(),
            "{:?}",
            names(folder.path())
        );
    }
}

#[test]
fn a_run_after_a_killed_one_goes_on_as_if_nothing_had_been() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let run = started(&out);
    signal(&run, "KILL");
    assert_eq!(ended(run).status.code(), None);
    succeeds(&words(&into(&out)));
    assert_eq!(names(&out), ["report.html", "report.json"]);
}
