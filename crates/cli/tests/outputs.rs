//! What is written never destroys what is read: outputs that would are refused before any work, and nothing is touched.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{Folder, names, refuses, succeeds};

const TRIANGLE: &str = "mtllib sheet.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl sheet\nf 1/1 2/2 3/3\n";
const SHEET: &str = "newmtl sheet\nmap_Kd sheet.png\n";
const POSES: &str = r#"{"projection": {"perspective": {"fov_y_degrees": 45, "near": 0.1}},
    "poses": [{"eye": [0, 0, 9], "target": [0, 0, 0]}]}"#;

/// A folder with a scene file and what it refers to, and a path file.
fn sheet() -> Folder {
    let folder = Folder::new();
    folder.write("sheet.obj", TRIANGLE);
    folder.write("sheet.mtl", SHEET);
    let white = image::RgbaImage::from_pixel(2, 2, image::Rgba([255; 4]));
    white.save(folder.path("sheet.png")).unwrap();
    folder.write("path.json", POSES);
    folder
}

/// Every file's name and contents.
fn contents(folder: &Folder) -> Vec<(PathBuf, Vec<u8>)> {
    let entries = fs::read_dir(folder.path("")).unwrap();
    let mut files: Vec<_> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_file())
        .map(|path| (path.clone(), fs::read(path).unwrap()))
        .collect();
    files.sort();
    files
}

/// The run is refused with these words, and no file has changed.
fn keeps(folder: &Folder, arguments: &[&str], words: &[&str]) {
    let before = contents(folder);
    refuses(arguments, 2, words);
    assert!(contents(folder) == before, "{arguments:?} changed a file");
}

/// `render` with these further arguments, drawn small.
fn render<'a>(scene: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["render", scene, "--size", "32x24"], more].concat()
}

#[test]
fn an_image_never_replaces_what_it_is_drawn_from() {
    let folder = sheet();
    let [scene, path, image, texture] =
        ["sheet.obj", "path.json", "image.png", "sheet.png"].map(|name| folder.at(name));
    keeps(
        &folder,
        &render(&scene, &["-o", &scene]),
        &["--output", "the scene", "sheet.obj"],
    );
    for (onto, named) in [
        (&scene, "the scene"),
        (&path, "--path"),
        (&image, "--output"),
    ] {
        let sketch = ["-o", &image, "--path", &path, "--sketch", onto];
        keeps(
            &folder,
            &render(&scene, &sketch),
            &["--sketch", named, onto],
        );
    }
    // A file that the scene refers to is known once the scene is read.
    keeps(
        &folder,
        &render(&scene, &["-o", &texture]),
        &["--output", "a file of the scene", "sheet.png"],
    );
    let volume = folder.at("volume.png");
    fs::write(&volume, "no volume").unwrap();
    let asked = ["--volume", &volume, "-o", &volume];
    keeps(
        &folder,
        &render("grid:2", &asked),
        &["--output", "--volume", "volume.png"],
    );
}

#[test]
fn names_of_two_eyes_are_held_against_the_inputs_too() {
    let folder = sheet();
    fs::rename(folder.path("path.json"), folder.path("a-left.png")).unwrap();
    let [path, image, left] = ["a-left.png", "a.png", "b-right.png"].map(|name| folder.at(name));
    let asked = ["--layout", "separate", "--path", &path, "-o", &image];
    keeps(
        &folder,
        &render("grid:2", &asked),
        &["a-left.png", "--path"],
    );
    let asked = ["--stereo", "--strategy", "occupancy-map", "-o", &left];
    let sketch = folder.at("b.png");
    let asked = [&asked[..], &["--sketch", &sketch]].concat();
    keeps(
        &folder,
        &render("grid:2", &asked),
        &["--sketch", "--output", "b-right.png"],
    );
    // Side by side there is one image, and its name is its own.
    let asked = ["--stereo", "--path", &path, "-o", &image];
    succeeds(&render("grid:2", &asked));
    assert!(folder.path("a.png").is_file());
}

#[test]
fn only_png_images_and_svg_sketches_are_written() {
    let folder = sheet();
    for name in ["image.jpg", "image", "image.glb", ".png"] {
        let image = folder.at(name);
        keeps(&folder, &render("grid:2", &["-o", &image]), &[name, ".png"]);
    }
    let image = folder.at("image.png");
    for name in ["sketch", "sketch.png", "sketch.glb"] {
        let sketch = folder.at(name);
        let asked = ["-o", &image, "--sketch", &sketch];
        keeps(&folder, &render("grid:2", &asked), &[name, ".svg"]);
    }
}

#[test]
fn a_report_never_replaces_what_it_is_about() {
    let folder = sheet();
    let out = folder.at(".");
    for name in ["report.json", "trade.svg", "3-three-pass-worst.png"] {
        fs::write(folder.path(name), POSES).unwrap();
        let path = folder.at(name);
        let asked = ["compare", "grid:2", "--path", &path, "--out", &out];
        keeps(&folder, &asked, &["--out", "--path", name]);
        let sweep = ["--strategy", "three-pass", "--vary", "threshold=1"];
        let asked = ["sweep", "grid:2", "--path", &path, "--out", &out];
        keeps(
            &folder,
            &[&asked[..], &sweep].concat(),
            &["--out", "--path", name],
        );
        fs::remove_file(path).unwrap();
    }
    let file = folder.at("sheet.obj");
    let asked = ["compare", "grid:2", "--out", &file];
    keeps(&folder, &asked, &["--out", "sheet.obj", "folder"]);
    fs::create_dir(folder.path("report.html")).unwrap();
    let asked = ["compare", "grid:2", "--out", &out];
    keeps(&folder, &asked, &["--out", "report.html", "a folder"]);
}

#[test]
fn whatever_a_report_writes_is_known_to_the_check() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let wrong = "three-pass:latency=same-frame:threshold=40";
    let asked = [
        "sweep", "grid:5", "--size", "64x48", "--frames", "3", "--quiet",
    ];
    let sweep = ["--strategy", wrong, "--vary", "scale=0.5", "--out"];
    succeeds(&[&asked[..], &sweep, &[out.to_str().unwrap()]].concat());
    let names = names(&out);
    assert!(
        names.iter().any(|name| name.ends_with("worst.png")),
        "{names:?}"
    );
    for name in names {
        assert!(antumbra::measure::compare::is_report_file(&name), "{name}");
    }
    for name in [
        "report.txt",
        "worst.png",
        "a-worst.png",
        "-worst.png",
        "1-a-best.png",
        "1-a/b-worst.png",
        "1-/../../b-worst.png",
    ] {
        assert!(!antumbra::measure::compare::is_report_file(name), "{name}");
    }
}

#[test]
fn a_prepared_scene_never_replaces_its_input() {
    let folder = sheet();
    let [input, other, volume] = ["a.glb", "b.glb", "c.vol"].map(|name| folder.at(name));
    for name in [&input, &other, &volume] {
        fs::write(name, "not read").unwrap();
    }
    let asked = ["prepare", &input, "-o", &input];
    keeps(&folder, &asked, &["--output", "the input", "a.glb"]);
    let asked = ["prepare", &input, &other, "-o", &other];
    keeps(&folder, &asked, &["--output", "the input", "b.glb"]);
    let asked = ["prepare", &input, "--grid", &volume, "-o", &volume];
    keeps(&folder, &asked, &["--output", "--grid", "c.vol"]);
}

#[test]
fn a_path_is_followed_to_where_it_leads() {
    let folder = sheet();
    fs::create_dir(folder.path("deep")).unwrap();
    let aside = folder.at("deep/../path.json");
    let [path, image] = ["path.json", "image.png"].map(|name| folder.at(name));
    let sketch = ["-o", &image, "--path", &path, "--sketch", &aside];
    keeps(&folder, &render("grid:2", &sketch), &["--sketch", "--path"]);
    // Neither exists yet.
    let other = folder.at("deep/../image.png");
    let sketch = ["-o", &image, "--sketch", &other];
    keeps(
        &folder,
        &render("grid:2", &sketch),
        &["--sketch", "--output"],
    );
}

#[cfg(unix)]
mod unix {
    use super::*;

    use std::os::unix::fs::{FileTypeExt, symlink};
    use std::os::unix::net::UnixListener;

    fn link(folder: &Folder, to: &Path, name: &str) -> String {
        symlink(to, folder.path(name)).unwrap();
        folder.at(name)
    }

    #[test]
    fn links_are_followed() {
        let folder = sheet();
        let path = folder.at("path.json");
        let soft = link(&folder, Path::new("path.json"), "soft.png");
        keeps(
            &folder,
            &render("grid:2", &["--path", &path, "-o", &soft]),
            &["soft.png", "--path"],
        );
        let hard = folder.at("hard.png");
        fs::hard_link(&path, &hard).unwrap();
        keeps(
            &folder,
            &render("grid:2", &["--path", &path, "-o", &hard]),
            &["hard.png", "--path"],
        );
        // The input may be the link, and a link may lead to where nothing is yet.
        let input = link(&folder, Path::new("plain.png"), "poses.json");
        let plain = folder.at("plain.png");
        fs::write(&plain, POSES).unwrap();
        keeps(
            &folder,
            &render("grid:2", &["--path", &input, "-o", &plain]),
            &["plain.png", "poses.json"],
        );
        let dangling = link(&folder, Path::new("later.png"), "dangling.svg");
        let later = folder.at("later.png");
        keeps(
            &folder,
            &render("grid:2", &["-o", &later, "--sketch", &dangling]),
            &["later.png", "dangling.svg"],
        );
        let round = link(&folder, Path::new("round.png"), "round.png");
        let asked = render("grid:2", &["-o", &round, "--path", &path]);
        let output = common::antumbra(&asked);
        assert!(!common::stderr(&output).contains("panicked"));
        // Through a linked folder.
        let home = link(&folder, Path::new("."), "home");
        let aside = format!("{home}/path.json");
        keeps(
            &folder,
            &render(
                "grid:2",
                &["-o", &later, "--path", &path, "--sketch", &aside],
            ),
            &["--sketch", "--path"],
        );
    }

    #[test]
    fn what_is_no_regular_file_stays_what_it_is() {
        let folder = sheet();
        let socket = folder.at("socket.png");
        let _listener = UnixListener::bind(&socket).unwrap();
        keeps(
            &folder,
            &render("grid:2", &["-o", &socket]),
            &["socket.png", "a socket"],
        );
        let inside = folder.at("folder.png");
        fs::create_dir(&inside).unwrap();
        keeps(
            &folder,
            &render("grid:2", &["-o", &inside]),
            &["folder.png", "a folder"],
        );
        let fifo = folder.at("fifo.png");
        let made = std::process::Command::new("mkfifo").arg(&fifo).status();
        if made.is_ok_and(|status| status.success()) {
            keeps(
                &folder,
                &render("grid:2", &["-o", &fifo]),
                &["fifo.png", "a FIFO"],
            );
        }
        let device = link(&folder, Path::new("/dev/null"), "null.png");
        keeps(
            &folder,
            &render("grid:2", &["-o", &device]),
            &["null.png", "a device"],
        );
        let sketch = ["-o", &folder.at("image.png"), "--sketch", "/dev/null"];
        keeps(
            &folder,
            &render("grid:2", &sketch),
            &["/dev/null", "a device"],
        );
        let null = fs::metadata("/dev/null").unwrap().file_type();
        assert!(null.is_char_device());
        let scene = link(&folder, Path::new("/dev/null"), "null.glb");
        let asked = ["prepare", "terrain:200", "-o", &scene];
        keeps(&folder, &asked, &["null.glb", "a device"]);
    }
}
