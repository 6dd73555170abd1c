//! Storms: hundreds of concurrent, killed and starved runs. They take many minutes, and need Linux, root, and `unshare` and `mount`:
//!
//!     cargo test --release -p antumbra-cli --test storms -- --ignored --nocapture --test-threads 1
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output};
use std::time::Instant;

use base64::Engine as _;
use common::{PROGRAM, caught, names, stderr};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::Value;

/// A comparison with wrong pixels, hence with pictures, of a scene of its own.
fn compare(scene: &str, out: &Path) -> Vec<String> {
    let words = [
        "compare",
        scene,
        "--strategies",
        "three-pass:latency=same-frame:threshold=40",
        "--size",
        "64x48",
        "--frames",
        "2",
        "--out",
    ];
    let words = words.iter().map(|word| (*word).to_owned());
    words.chain([out.to_str().unwrap().to_owned()]).collect()
}

fn sweep(out: &Path) -> Vec<String> {
    let words = [
        "sweep",
        "grid:4",
        "--strategy",
        "three-pass:latency=same-frame",
        "--vary",
        "threshold=40,60",
        "--size",
        "64x48",
        "--frames",
        "2",
        "--out",
    ];
    let words = words.iter().map(|word| (*word).to_owned());
    words.chain([out.to_str().unwrap().to_owned()]).collect()
}

/// The program, in this PID namespace or in one of its own.
fn program(arguments: &[String], apart: bool) -> Command {
    if !apart {
        return common::program(arguments);
    }
    let mut command = Command::new("unshare");
    command.args(["-pf", "--kill-child", PROGRAM]);
    caught(command, arguments)
}

fn start(arguments: &[String], apart: bool) -> Child {
    program(arguments, apart).spawn().unwrap()
}

/// What is in a folder that a report was, or was not, written into.
#[derive(Debug, PartialEq)]
enum Found {
    Nothing,
    Whole { scene: String },
}

/// Checks that a report is whole, with its page, its pictures and nothing else; `leftovers` may be there besides.
fn found(out: &Path, leftovers: bool) -> Found {
    let is_leftover = |name: &String| name.starts_with(".antumbra");
    let all = names(out);
    let there: Vec<&String> = all.iter().filter(|name| !is_leftover(name)).collect();
    assert!(leftovers || there.len() == all.len(), "{all:?}");
    if there.is_empty() {
        return Found::Nothing;
    }
    let report = fs::read_to_string(out.join("report.json")).unwrap_or_else(|_| panic!("{all:?}"));
    let report: Value = serde_json::from_str(&report).unwrap();
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    let scene = report["scene"]["name"].as_str().unwrap().to_owned();
    assert!(page.ends_with("</html>\n"));
    assert!(page.contains(&format!("<title>Occlusion culling: {scene}</title>")));
    let mut expected = vec!["report.html".to_owned(), "report.json".to_owned()];
    for strategy in report["strategies"].as_array().unwrap() {
        let Some(images) = strategy["worst"]["images"].as_object() else {
            continue;
        };
        for image in images.values() {
            let name = image.as_str().unwrap();
            let bytes = fs::read(out.join(name)).unwrap();
            let embedded = base64::engine::general_purpose::STANDARD.encode(bytes);
            let shown = strategy["error"]["wrong_pixels_percent"]["max"].as_f64() > Some(0.0);
            assert!(
                !shown || page.contains(&embedded),
                "{name} is another run's"
            );
            expected.push(name.to_owned());
        }
    }
    if report.get("sweep").is_some() {
        let plot = fs::read_to_string(out.join("trade.svg")).unwrap();
        assert!(plot.trim_end().ends_with("</svg>"));
        expected.push("trade.svg".to_owned());
    }
    expected.sort();
    expected.dedup();
    assert_eq!(there, expected.iter().collect::<Vec<_>>());
    Found::Whole { scene }
}

#[test]
#[ignore = "takes minutes"]
fn two_hundred_pairs_of_runs_into_one_folder() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let (mut refused, mut whole) = (0, 0);
    for pair in 0..200 {
        // Every second pair in PID namespaces of their own, where both runs have the same process id.
        let apart = pair % 2 == 1;
        let scenes = ["grid:4", "layer:4"];
        let runs = scenes.map(|scene| start(&compare(scene, &out), apart));
        let outputs = runs.map(|run| run.wait_with_output().unwrap());
        let mut written = Vec::new();
        for (scene, output) in scenes.into_iter().zip(&outputs) {
            match output.status.code() {
                Some(0) => {
                    whole += 1;
                    written.push(scene.to_owned());
                }
                Some(1) => {
                    refused += 1;
                    assert!(stderr(output).contains("another run"), "{}", stderr(output));
                }
                other => panic!("{other:?}: {}", stderr(output)),
            }
        }
        match found(&out, false) {
            Found::Whole { scene } => assert!(written.contains(&scene), "{scene}: {written:?}"),
            Found::Nothing => panic!("pair {pair}: neither run has written"),
        }
    }
    println!("{whole} runs whole, {refused} refused");
    assert_eq!(whole + refused, 400);
    assert!(refused > 0, "no two runs have met");
}

/// Ends runs at random moments by a signal; what is left is whole or nothing, also after the next run.
fn ended(make: &dyn Fn(&Path) -> Vec<String>, check: &dyn Fn(&Path, bool) -> bool, signal: &str) {
    let mut random = Pcg64Mcg::seed_from_u64(23);
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let begin = Instant::now();
    let output = program(&make(&out), false).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let whole = begin.elapsed();
    assert!(check(&out, false));
    let mut kept = 0;
    for moment in 0..50 {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let mut run = start(&make(&out), false);
        std::thread::sleep(whole.mul_f64(random.random_range(0.0..1.05)));
        let sent = Command::new("kill")
            .args(["-s", signal, &run.id().to_string()])
            .status();
        drop(sent);
        let status = run.wait().unwrap();
        let killed = signal == "KILL";
        match (killed, status.code()) {
            (_, Some(0)) | (true, None) | (false, Some(143)) => {}
            // Before the program listens to signals.
            (false, None) => {}
            other => panic!("{other:?}"),
        }
        kept += u32::from(check(&out, killed));
        let output = program(&make(&out), false).output().unwrap();
        assert!(
            output.status.success(),
            "moment {moment}: {}",
            stderr(&output)
        );
        assert!(check(&out, false));
    }
    println!("{signal}: {kept} of 50 had finished");
}

fn report_is_whole(out: &Path, leftovers: bool) -> bool {
    found(out, leftovers) != Found::Nothing
}

/// For `prepare`, the output is a file in the folder.
fn scene_is_whole(out: &Path, leftovers: bool) -> bool {
    let there = names(out.parent().unwrap());
    let part = |name: &String| name.starts_with(".antumbra");
    assert!(leftovers || !there.iter().any(part), "{there:?}");
    let file = out.with_extension("glb");
    if !file.exists() {
        return false;
    }
    let bytes = fs::read(&file).unwrap();
    let length = u32::from_le_bytes(bytes[8..12].try_into().unwrap());
    assert!(bytes.starts_with(b"glTF") && length as usize == bytes.len());
    true
}

fn prepare(out: &Path) -> Vec<String> {
    let file = out.with_extension("glb");
    let words = ["prepare", "terrain:600", "-o", file.to_str().unwrap()];
    words.map(str::to_owned).to_vec()
}

#[test]
#[ignore = "takes minutes"]
fn compare_is_ended_at_fifty_random_moments() {
    for signal in ["KILL", "TERM"] {
        ended(&|out| compare("grid:4", out), &report_is_whole, signal);
    }
}

#[test]
#[ignore = "takes minutes"]
fn sweep_is_ended_at_fifty_random_moments() {
    for signal in ["KILL", "TERM"] {
        ended(&|out| sweep(out), &report_is_whole, signal);
    }
}

#[test]
#[ignore = "takes minutes"]
fn prepare_is_ended_at_fifty_random_moments() {
    for signal in ["KILL", "TERM"] {
        ended(&|out| prepare(out), &scene_is_whole, signal);
    }
}

/// A file system of its own, until it is dropped.
struct Mounted {
    folder: tempfile::TempDir,
}

impl Mounted {
    fn of(size: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let options = format!("size={size}");
        let mounted = Command::new("mount")
            .args(["-t", "tmpfs", "-o", &options, "tmpfs"])
            .arg(folder.path())
            .status();
        assert!(mounted.unwrap().success(), "this test needs root");
        Self { folder }
    }

    fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    fn make_read_only(&self) {
        let mut mount = Command::new("mount");
        let mount = mount.args(["-o", "remount,ro"]).arg(self.folder.path());
        assert!(mount.status().unwrap().success());
    }
}

impl Drop for Mounted {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.folder.path()).status();
    }
}

fn fails(arguments: &[String], words: &[&str]) -> Output {
    let output = program(arguments, false).output().unwrap();
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{message}");
    for word in words {
        assert!(message.contains(word), "'{word}' is not in: {message}");
    }
    output
}

#[test]
#[ignore = "needs root"]
fn a_full_disk_and_a_read_only_one_leave_nothing_half() {
    // Room for the probe, and not for the report.
    let disk = Mounted::of("24k");
    for asked in [compare("grid:4", &disk.out()), sweep(&disk.out())] {
        let output = fails(&asked, &["No space left"]);
        let table = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(table.contains("three-pass"), "{table}");
        assert!(names(disk.folder.path()).is_empty());
    }
    fails(&prepare(&disk.out()), &["No space left"]);
    assert!(names(disk.folder.path()).is_empty());
    let image = disk.folder.path().join("a.png");
    let render = [
        "render",
        "grid:8",
        "--size",
        "400x300",
        "-o",
        image.to_str().unwrap(),
    ];
    fails(&render.map(str::to_owned), &["No space left"]);
    assert!(names(disk.folder.path()).is_empty());
    // Not even for the probe: nothing is measured.
    let full = Mounted::of("4k");
    fs::write(full.folder.path().join("taken"), [1; 4096]).unwrap();
    let begin = Instant::now();
    let output = fails(&compare("grid:20", &full.out()), &["No space left"]);
    assert!(
        output.stdout.is_empty(),
        "measured for {:?}",
        begin.elapsed()
    );
    assert_eq!(names(full.folder.path()), ["taken"]);
    let fixed = Mounted::of("1m");
    fixed.make_read_only();
    for asked in [
        compare("grid:20", &fixed.out()),
        sweep(&fixed.out()),
        prepare(&fixed.out()),
    ] {
        let output = fails(&asked, &["Read-only"]);
        assert!(output.stdout.is_empty());
    }
    assert!(names(fixed.folder.path()).is_empty());
}
