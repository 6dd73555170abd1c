//! Rasters, surfaces, grids and SEG-Y files as people have them: what is drawn of them, and what is said.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;
#[path = "../../subsurface/tests/read_support/eclipse.rs"]
#[allow(dead_code)]
mod eclipse;
#[path = "../../subsurface/tests/read_support/segy.rs"]
#[allow(dead_code)]
mod segy;

use common::{Folder, antumbra, refuses, stderr, succeeds};

/// A hill in degrees, some 300 m wide.
fn degrees() -> Vec<u8> {
    let mut text =
        "ncols 30\nnrows 30\nxllcorner 8.0\nyllcorner 46.5\ncellsize 0.0001\n".to_owned();
    for at in 0..900 {
        let (x, y) = (f64::from(at % 30) - 15.0, f64::from(at / 30) - 15.0);
        text += &format!("{:.2} ", 100.0 + 60.0 * (-(x * x + y * y) / 60.0).exp());
    }
    text.into_bytes()
}

/// The shares of a picture that are not background: of its pixels, and of its width and height.
fn shares(path: &str) -> [f64; 3] {
    let image = image::open(path).unwrap().into_rgb8();
    let background = *image.get_pixel(0, 0);
    let shown = |(x, y): &(u32, u32)| *image.get_pixel(*x, *y) != background;
    let [width, height] = [image.width(), image.height()];
    let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let shown: Vec<(u32, u32)> = all.filter(shown).collect();
    let span = |of: fn(&(u32, u32)) -> u32| {
        let ends = shown.iter().map(of);
        ends.clone().max().unwrap_or(0) + 1 - ends.min().unwrap_or(0)
    };
    [
        shown.len() as f64 / f64::from(width * height),
        f64::from(span(|at| at.0)) / f64::from(width),
        f64::from(span(|at| at.1)) / f64::from(height),
    ]
}

#[test]
fn a_raster_in_degrees_is_a_hill_of_sane_proportions() {
    let folder = Folder::new();
    let (dem, image) = (folder.write("dem.asc", degrees()), folder.at("a.png"));
    // From the side: as wide as 30 cells of 7.65 m, and 60 m high.
    let side = r#"{"projection": {"orthographic": {"height": 240.0, "near": 0.0, "far": 9000000.0}}, "poses": [{"eye": [612431, 130, 0], "target": [612431, 130, -5170750]}]}"#;
    let path = folder.write("side.json", side.as_bytes());
    let render = [
        "render", &dem, "--path", &path, "--size", "320x240", "-o", &image,
    ];
    let output = antumbra(&render);
    let said = stderr(&output);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("can only be degrees"), "{said}");
    let [_, wide, high] = shares(&image);
    assert!((0.6..0.75).contains(&wide), "{wide}");
    assert!((0.2..0.3).contains(&high), "{high}");
    let quiet = antumbra(&[&render[..], &["--quiet"]].concat());
    assert_eq!(stderr(&quiet), "");
    refuses(
        &[&render[..], &["--units", "furlongs"]].concat(),
        2,
        &["no unit", "us-ft"],
    );
}

#[test]
fn a_segy_file_is_shown_and_prepared() {
    let folder = Folder::new();
    let made = segy::Segy {
        samples: 40,
        inlines: [1, 36, 1],
        crosslines: [1, 40, 1],
        ..segy::Segy::new(1)
    };
    let file = folder.write("cube.segy", made.write());
    let image = folder.at("a.png");
    let render = [
        "render", "grid:2", "--volume", &file, "-o", &image, "--size", "64x48",
    ];
    let output = antumbra(&render);
    let said = stderr(&output);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("--velocity"), "{said}");
    let volume = folder.at("cube.vol");
    let prepare = ["prepare", &file, "-o", &volume, "--velocity", "3000"];
    let said = succeeds(&prepare);
    assert!(said.contains("36 x 40 x 40 samples"), "{said}");
    succeeds(&[
        "render", "grid:2", "--volume", &volume, "-o", &image, "--size", "64x48",
    ]);
    let range = [&prepare[..], &["--range", "-5..5"]].concat();
    assert!(succeeds(&range).contains("-5 to 5"));
    refuses(
        &[&prepare[..], &["--trace-bytes", "cdp=1"]].concat(),
        2,
        &["inline"],
    );
    refuses(
        &[&prepare[..], &["--range", "5..1"]].concat(),
        2,
        &["-2500..2500"],
    );
    let broken = folder.write("broken.sgy", [0; 5000]);
    refuses(&["prepare", &broken, "-o", &volume], 1, &["sample format"]);
}

#[test]
fn a_property_goes_with_its_grid() {
    let folder = Folder::new();
    let grid = folder.write("FIELD.EGRID", eclipse::binary());
    let init = folder.write("FIELD.INIT", eclipse::results());
    let volume = folder.at("poro.vol");
    let prepare = ["prepare", &init, "-o", &volume];
    refuses(&prepare, 2, &["--grid"]);
    let with_grid = [&prepare[..], &["--grid", &grid]].concat();
    refuses(&with_grid, 1, &["PORO, PORV", "--property"]);
    let said = succeeds(&[&with_grid[..], &["--property", "PORO"]].concat());
    assert!(said.contains("0.1 to 0.21"), "{said}");
    let scene = folder.at("field.glb");
    let said = succeeds(&["prepare", &grid, "-o", &scene, "--tiles", "1"]);
    assert!(said.contains("3 horizons"), "{said}");
    // A parameter alone says what it needs.
    let mut roff =
        b"roff-asc\ntag filedata\nint byteswaptest 1\nchar filetype \"parameter\"\nendtag\n"
            .to_vec();
    roff.extend(b"tag eof\nendtag\n");
    let parameter = folder.write("poro.roff", &roff);
    refuses(
        &["prepare", &parameter, "-o", &scene],
        1,
        &["--grid", "--volume"],
    );
}

#[test]
fn files_with_one_note_share_a_line() {
    let folder = Folder::new();
    let points = "0 0 5\n10 0 6\n0 10 7\n10 10 9\n";
    let files =
        ["a.xyz", "b.xyz", "c.xyz", "d.xyz"].map(|name| folder.write(name, points.as_bytes()));
    let out = folder.at("out.glb");
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    let prepare = [&["prepare", "-o", &out, "--tiles", "1"], &files[..]].concat();
    let said = stderr(&antumbra(&prepare));
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), 2, "{said}");
    assert!(
        lines.iter().all(|line| line.contains("c.xyz and 1 more")),
        "{said}"
    );
}
