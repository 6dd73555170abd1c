//! `antumbra prepare` as a person meets it: what it makes can be compared, and what it refuses it refuses in words.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::path::Path;

use common::{refuses, succeeds};

/// An Irap binary surface of `columns` x `rows` nodes 25 m apart.
fn irap(columns: i32, rows: i32, value: impl Fn(i32, i32) -> f32) -> Vec<u8> {
    fn record(file: &mut Vec<u8>, body: &[[u8; 4]]) {
        let length = (body.len() as i32 * 4).to_be_bytes();
        file.extend(length);
        file.extend(body.as_flattened());
        file.extend(length);
    }
    let int = |v: i32| v.to_be_bytes();
    let real = |v: f32| v.to_be_bytes();
    let mut file = Vec::new();
    let (wide, high) = ((columns - 1) as f32 * 25.0, (rows - 1) as f32 * 25.0);
    let head = [
        int(-996),
        int(rows),
        real(0.0),
        real(wide),
        real(0.0),
        real(high),
        real(25.0),
        real(25.0),
    ];
    record(&mut file, &head);
    record(&mut file, &[int(columns), real(0.0), real(0.0), real(0.0)]);
    record(&mut file, &[int(0); 7]);
    for row in 0..rows {
        let row: Vec<[u8; 4]> = (0..columns)
            .map(|column| real(value(column, row)))
            .collect();
        record(&mut file, &row);
    }
    file
}

const UNDEFINED: f32 = 9_999_900.0;

fn write(path: &Path, bytes: &[u8]) -> String {
    std::fs::write(path, bytes).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn surfaces_become_a_scene_that_can_be_compared() {
    let dir = tempfile::tempdir().unwrap();
    let place = |name: &str| dir.path().join(name);
    let hills = |depth: f32| {
        irap(60, 50, move |c, r| {
            depth + (c as f32 / 6.0).sin() * 40.0 + r as f32
        })
    };
    let top = write(&place("top.gri"), &hills(1000.0));
    let base = write(&place("base.gri"), &hills(1400.0));
    let scene = place("scene.glb");
    let scene = scene.to_str().unwrap();
    let said = succeeds(&[
        "prepare",
        &top,
        &base,
        "-o",
        scene,
        "--tiles",
        "4",
        "--decimation",
        "25",
    ]);
    assert!(
        said.contains("2 horizons and 0 faults in 32 entities"),
        "{said}"
    );
    assert!(said.contains("11564 triangles"), "{said}");

    let out = place("out");
    let out = out.to_str().unwrap();
    succeeds(&[
        "compare",
        scene,
        "--strategies",
        "none,three-pass:latency=same-frame",
        "--frames",
        "3",
        "--size",
        "200x160",
        "--out",
        out,
    ]);
    let report = std::fs::read(place("out").join("report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_slice(&report).unwrap();
    assert_eq!(report["scene"]["entities"], 32);
    let drawn = &report["strategies"][1]["drawn"]["entities"];
    assert!(
        drawn.as_f64().unwrap() < 32.0,
        "nothing was culled: {drawn}"
    );
}

#[test]
fn a_model_becomes_a_volume_whose_sections_are_shown() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("model.vol");
    let volume = path.to_str().unwrap();
    let said = succeeds(&["prepare", "subsurface:40", "-o", volume]);
    assert!(said.contains("samples"), "{said}");
    let image = dir.path().join("image.png");
    let image = image.to_str().unwrap();
    let shown = [
        "--volume",
        volume,
        "--slice",
        "time=30",
        "--lens",
        "5..20,5..20,10..40",
        "--size",
        "200x160",
        "-o",
        image,
    ];
    succeeds(&[&["render", "subsurface:40"], &shown[..]].concat());

    let lens = [
        "--volume",
        volume,
        "--lens",
        "5..20,5..20,10..4000",
        "--size",
        "64x64",
        "-o",
        image,
    ];
    refuses(
        &[&["render", "subsurface:40"], &lens[..]].concat(),
        1,
        &["lens", "outside the volume", "time"],
    );
    let slice = [
        "--volume",
        volume,
        "--slice",
        "inline=70000",
        "--size",
        "64x64",
        "-o",
        image,
    ];
    refuses(
        &[&["render", "subsurface:40"], &slice[..]].concat(),
        1,
        &["slice", "outside", "inline"],
    );

    let whole = std::fs::read(&path).unwrap();
    std::fs::write(&path, &whole[..whole.len() - 1]).unwrap();
    let shown = ["render", "subsurface:40", "--volume", volume, "-o", image];
    refuses(&shown, 1, &["model.vol", &whole.len().to_string()]);
}

#[test]
fn files_that_are_not_what_they_say_are_refused_and_leave_nothing_behind() {
    let dir = tempfile::tempdir().unwrap();
    let place = |name: &str| dir.path().join(name);
    let good = irap(20, 20, |c, r| (c + r) as f32);
    let mut lying = good.clone();
    // Rows: as many as there are bytes for in no file.
    lying[8..12].copy_from_slice(&2_000_000_000_i32.to_be_bytes());
    let cases = [
        ("short.gri", good[..good.len() / 2].to_vec(), "Irap"),
        ("lying.gri", lying, "Irap"),
        ("empty.gri", irap(20, 20, |_, _| UNDEFINED), "undefined"),
        (
            "short.roff",
            b"roff-bin\0#ROFF file#\0tag\0filedata\0int\0byteswaptest\0".to_vec(),
            "ROFF",
        ),
        ("none.csv", b"x,y,z,surface\n".to_vec(), "none.csv"),
        ("words.txt", b"nothing of the kind".to_vec(), "words.txt"),
    ];
    let scene = place("scene.glb");
    for (name, bytes, word) in cases {
        let input = write(&place(name), &bytes);
        refuses(
            &["prepare", &input, "-o", scene.to_str().unwrap()],
            1,
            &[name, word],
        );
        assert!(!scene.exists(), "{name} left a scene behind");
    }
    let missing = place("missing.gri");
    refuses(
        &[
            "prepare",
            missing.to_str().unwrap(),
            "-o",
            scene.to_str().unwrap(),
        ],
        1,
        &["missing.gri"],
    );
}

#[test]
fn wrong_words_are_refused_as_wrong_usage() {
    refuses(
        &["prepare", "subsurface:40", "-o", "scene.obj"],
        2,
        &[".glb", ".vol"],
    );
    refuses(
        &[
            "prepare",
            "subsurface:40",
            "-o",
            "scene.glb",
            "--tiles",
            "0",
        ],
        2,
        &["tiles", "1 to 64"],
    );
    refuses(
        &["prepare", "subsurface:40:seed=x", "-o", "scene.glb"],
        2,
        &["seed", "number"],
    );
    refuses(
        &["render", "subsurface:40:colour=red", "-o", "x.png"],
        2,
        &["colour", "decimation"],
    );
    refuses(
        &["render", "grid:4:tiles=3", "-o", "x.png"],
        2,
        &["tiles", "grid"],
    );
    refuses(
        &["render", "grid:4", "--lens", "0..1,0..1", "-o", "x.png"],
        2,
        &["100..180"],
    );
    refuses(
        &["render", "grid:4", "--slice", "time=3", "-o", "x.png"],
        2,
        &["--volume"],
    );
}
