//! Horizons from grids and points in text, as mapping programs write them, and the units of surfaces.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

use antumbra_scene::Geometry;
use antumbra_subsurface::Surface;
use antumbra_subsurface::read::{self, ReadOptions, SurfaceFile, ZPositive};
use glam::{DVec3, Vec3};

fn read_with(name: &str, text: &str, options: &ReadOptions) -> Result<SurfaceFile, String> {
    let read =
        read::surface_file_from_bytes(Path::new(name), text.as_bytes(), options, &mut |_, _| ());
    read.map_err(|error| error.to_string())
}

fn read(name: &str, text: &str) -> SurfaceFile {
    read_with(name, text, &ReadOptions::default()).unwrap()
}

fn refused(name: &str, text: &str, word: &str) {
    let error = read_with(name, text, &ReadOptions::default()).unwrap_err();
    assert!(error.contains(word), "`{error}` does not say `{word}`");
}

fn points(surface: &Surface) -> Vec<DVec3> {
    let Geometry { positions, .. } = &surface.geometry;
    let world = |position: &[f32; 3]| surface.origin + Vec3::from(*position).as_dvec3();
    positions.iter().map(world).collect()
}

fn has(surface: &Surface, point: DVec3) {
    let near = points(surface)
        .iter()
        .any(|found| found.distance(point) < 0.01);
    assert!(near, "{point} is none of {:?}", points(surface));
}

fn faces_up(surface: &Surface) -> bool {
    let mut normals = surface.geometry.normals.iter();
    normals.all(|normal| normal[1] > 0.0)
}

fn says(file: &SurfaceFile, word: &str) {
    let said = file.notes.iter().any(|note| note.contains(word));
    assert!(said, "no note says `{word}`: {:?}", file.notes);
}

/// Three rows and two columns, 100 m apart; the node in the north-east is missing.
fn assert_grid(surface: &Surface) {
    assert_eq!(points(surface).len(), 5);
    has(surface, DVec3::new(1000.0, -10.0, -5200.0));
    has(surface, DVec3::new(1000.0, -11.0, -5100.0));
    has(surface, DVec3::new(1000.0, -12.0, -5000.0));
    has(surface, DVec3::new(1100.0, -14.0, -5100.0));
    has(surface, DVec3::new(1100.0, -15.0, -5000.0));
    assert!(faces_up(surface));
}

const ZMAP: &str = "! remark\n@top HEADER , GRID, 2\n15, -99999.0000, , 4, 1\n\
    3, 2, 1000.0, 1100.0, 5000.0, 5200.0\n0.0, 0.0, 0.0\n@\n+ values follow\n\
    10.0 11.0\n12.0\n-99999.0000 14.0\n15.0\n";

const CPS3: &str = "FSASCI 0 1 COMPUTED 0 1.0E+30\nFSATTR 0 0\nFSLIMI 1000 1100 5000 5200 10 15\n\
    FSNROW 3 2\nFSXINC 100 100\n->top\n10 11 12\n1.0E+30 14 15\n";

#[test]
fn zmap_grids_go_down_their_columns() {
    let file = read("top.zmap", ZMAP);
    assert_grid(&file.surfaces[0]);
    assert_eq!(file.surfaces[0].name, "top");
    says(&file, "no unit");
    // Told by what it holds.
    assert_grid(&read("top.map", ZMAP).surfaces[0]);
    let no_text = ZMAP.replace("-99999.0000, ,", ", -99999.0000 ,");
    assert_grid(&read("top.dat", &no_text).surfaces[0]);
    refused("a.zmap", "@a, DATA, 5\n@\n", "GRID");
    refused("a.zmap", &ZMAP.replace("\n@\n", "\n"), "header");
    refused(
        "a.zmap",
        &ZMAP.replace("3, 2, 1000", "300, 2000, 1000"),
        "truncated",
    );
    refused("a.zmap", &ZMAP.replace("15.0\n", ""), "ends");
    refused("a.zmap", "@a, GRID, 5\n1\n", "header");
}

#[test]
fn cps3_grids_go_down_their_columns() {
    assert_grid(&read("top.cps3", CPS3).surfaces[0]);
    assert_grid(&read("top.grd", CPS3).surfaces[0]);
    refused("a.cps3", &CPS3.replace("FSLIMI", "FSOTHER"), "FSLIMI");
    refused("a.cps3", &CPS3.replace("FSNROW 3 2", "FSNROW 3"), "FSNROW");
    refused(
        "a.cps3",
        &CPS3.replace("FSNROW 3 2", "FSNROW 3000 2000"),
        "truncated",
    );
    refused("a.cps3", &CPS3.replace(" 15\n", "\n"), "ends");
}

/// Lines 10, 12 and 14, crosslines 5 and 6, rotated; one node is missing.
fn ijxyz(decimals: &str) -> String {
    let mut text = "@File_Version: 4\n#Project-> x\n".to_owned();
    for i in 0..3 {
        for c in 0..2 {
            if (i, c) == (1, 1) {
                continue;
            }
            let (x, y) = (
                1000.0 + 24.0 * f64::from(i) - 7.0 * f64::from(c),
                5000.0 + 7.0 * f64::from(i) + 24.0 * f64::from(c),
            );
            text += &format!("{}{decimals} {} {x} {y} {}\n", 10 + 2 * i, 5 + c, 1500 + i);
        }
    }
    text + "EOB"
}

#[test]
fn ijxyz_is_a_grid_of_lines() {
    for text in [ijxyz(""), ijxyz(".0")] {
        let file = read("top.dat", &text);
        let surface = &file.surfaces[0];
        assert_eq!(points(surface).len(), 5);
        has(surface, DVec3::new(1000.0, -1500.0, -5000.0));
        has(surface, DVec3::new(1041.0, -1502.0, -5038.0));
        has(surface, DVec3::new(1024.0, -1501.0, -5007.0));
        assert!(faces_up(surface));
    }
    refused("a.dat", "1 1 0 0 5\n1 1 0 0 6\n", "span no plan");
    refused(
        "a.dat",
        "1 1 0 0 5\n1 2 0 9 6\n2 x 9 0 7\n",
        "`x` is no number",
    );
    let sparse = "1 1 0 0 5\n100000 100000 0 9 6\n2 7 9 0 7\n";
    refused("a.dat", sparse, "almost all of it empty");
}

#[test]
fn points_need_no_title() {
    let text = "0 0 100\n100,0;110\n# remark\n0\t100 120\n100 100 130 7 9\n";
    for name in ["a.xyz", "a.dat", "a.csv", "a.txt", "a.poi"] {
        let file = read(name, text);
        assert_eq!(points(&file.surfaces[0]).len(), 4);
        has(&file.surfaces[0], DVec3::new(100.0, 110.0, 0.0));
        says(&file, "no title");
    }
    let down = ReadOptions {
        z_positive: Some(ZPositive::Down),
        ..ReadOptions::default()
    };
    let file = read_with("a.xyz", text, &down).unwrap();
    has(&file.surfaces[0], DVec3::new(100.0, -110.0, 0.0));
    refused("a.xyz", "0 0 1\n0 0\n", "line 2");
    refused("a.xyz", "0 0 1e300\n1 0 0\n0 1 0\n", "span no triangle");
    // A title makes it a table of picks.
    refused("a.csv", "a,b,c\n1,2,3\n", "no column");
}

/// An L of points, 100 apart: its outline is concave.
const CORNER: &str = "0 0 1\n100 0 1\n200 0 1\n0 100 1\n0 200 1\n100 100 1\n";

#[test]
fn the_longest_edge_is_in_metres_whatever_the_unit_of_the_points() {
    let triangles = |name: &str, text: &str, units: &str, longest: f64| {
        let options = ReadOptions {
            units: units.parse().unwrap(),
            longest_edge: Some(longest),
            ..ReadOptions::default()
        };
        let read = read_with(name, text, &options);
        read.map(|file| file.surfaces[0].geometry.triangle_count())
    };
    // Edges of 100 and 141, and no triangle with a longer one.
    let titled = format!("x,y,z\n{}", CORNER.replace(' ', ","));
    for (name, text) in [("a.xyz", CORNER), ("a.csv", &titled)] {
        assert_eq!(triangles(name, text, "m", 150.0).unwrap(), 4);
        assert_eq!(triangles(name, text, "ft", 50.0).unwrap(), 4);
        assert_eq!(triangles(name, text, "km", 150_000.0).unwrap(), 4);
        let none = triangles(name, text, "km", 150.0).unwrap_err();
        assert!(
            none.contains("no triangle with edges up to 150 m"),
            "{none}"
        );
        for wrong in [0.0, -1.0, f64::NAN] {
            let error = triangles(name, text, "m", wrong).unwrap_err();
            assert!(error.contains("positive"), "{error}");
        }
    }
}

#[test]
fn surfer_grids_are_horizons() {
    let text = "DSAA\n2 3\n1000 1100\n5000 5200\n10 15\n-12 -15\n-11 -14\n-10 1.70141e38\n";
    assert_grid(&read("top.grd", text).surfaces[0]);
    let mut old = b"DSBB".to_vec();
    old.extend([2, 0, 3, 0]);
    for number in [1000.0, 1100.0, 5000.0, 5200.0, 10.0, 15.0_f64] {
        old.extend(number.to_le_bytes());
    }
    let values = [-12.0, -15.0, -11.0, -14.0, -10.0, 1.701_41e38_f32];
    values
        .iter()
        .for_each(|value| old.extend(value.to_le_bytes()));
    let mut new = [&b"DSRB"[..], &4_u32.to_le_bytes(), &1_u32.to_le_bytes()].concat();
    new.extend([&b"GRID"[..], &72_u32.to_le_bytes()].concat());
    new.extend([3_i32, 2].iter().flat_map(|side| side.to_le_bytes()));
    for number in [
        1000.0,
        5000.0,
        100.0,
        100.0,
        10.0,
        15.0,
        0.0,
        1.701_41e38_f64,
    ] {
        new.extend(number.to_le_bytes());
    }
    new.extend([&b"FLTI"[..], &4_u32.to_le_bytes(), &[0; 4]].concat());
    new.extend([&b"DATA"[..], &48_u32.to_le_bytes()].concat());
    values
        .iter()
        .for_each(|value| new.extend(f64::from(*value).to_le_bytes()));
    for bytes in [&old, &new] {
        let options = ReadOptions::default();
        let read = |bytes: &[u8]| {
            read::surface_file_from_bytes(Path::new("a.grd"), bytes, &options, &mut |_, _| ())
        };
        assert_grid(&read(bytes).unwrap().surfaces[0]);
        for end in 0..bytes.len() {
            assert!(read(&bytes[..end]).is_err(), "{end}");
        }
    }
}

#[test]
fn a_projection_file_beside_a_raster_names_the_units_of_its_horizon() {
    let text = "ncols 2\nnrows 3\nxllcenter 1000\nyllcenter 5000\ncellsize 100\n-12 -15\n-11 -14\n-10 -13\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("top.asc");
    std::fs::write(&path, text).unwrap();
    std::fs::write(path.with_extension("prj"), "Projection UTM\nUnits FEET\n").unwrap();
    let file = read::surface_file(&path, &ReadOptions::default(), &mut |_, _| ()).unwrap();
    has(
        &file.surfaces[0],
        DVec3::new(304.8, -12.0, -5200.0 * 0.3048),
    );
    says(&file, "places are feet");
    // From memory nothing lies beside it.
    has(
        &read("top.asc", text).surfaces[0],
        DVec3::new(1000.0, -12.0, -5200.0),
    );
}

#[test]
fn the_length_of_a_raster_is_taken_once() {
    let grid = "ncols 2\nnrows 3\nxllcenter 1000\nyllcenter 5000\ncellsize 100\n-12 -15\n-11 -14\n-10 -13\n";
    let text = grid.to_owned() + &" ".repeat(1 << 20);
    let options = |max_memory| ReadOptions {
        max_memory: Some(max_memory),
        ..ReadOptions::default()
    };
    read_with("top.asc", &text, &options(3 << 19)).unwrap();
    let error = read_with("top.asc", &text, &options(1 << 20)).unwrap_err();
    assert!(error.contains("memory"), "{error}");
}

const FEET: &str = "GOCAD TSurf 1\nHEADER {\nname:F1\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\n\
    AXIS_NAME \"X\" \"Y\" \"Z\"\nAXIS_UNIT \"m\" \"m\" \"ft\"\nZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\nTFACE\n\
    VRTX 1 0 0 -1000\nVRTX 2 100 0 -1000\nVRTX 3 100 100 -1100\nTRGL 1 2 3\nEND\n";

#[test]
fn the_units_of_gocads_axes_are_applied() {
    let file = read("feet.ts", FEET);
    has(&file.surfaces[0], DVec3::new(100.0, -304.8, 0.0));
    has(&file.surfaces[0], DVec3::new(100.0, -335.28, -100.0));
    says(&file, "heights are feet");
    let all = FEET.replace("\"m\" \"m\" \"ft\"", "ft ft ft");
    has(
        &read("a.ts", &all).surfaces[0],
        DVec3::new(30.48, -304.8, 0.0),
    );
    let overridden = ReadOptions {
        units: "m".parse().unwrap(),
        ..ReadOptions::default()
    };
    let file = read_with("a.ts", FEET, &overridden).unwrap();
    has(&file.surfaces[0], DVec3::new(100.0, -1000.0, 0.0));
    assert!(file.notes.is_empty(), "{:?}", file.notes);
    let time = FEET.replace("\"ft\"", "\"ms\"");
    says(&read("a.ts", &time), "unit of heights, `ms`, is not known");
    let two = format!("{FEET}{}", FEET.replace("\"ft\"", "\"m\""));
    refused("a.ts", &two, "different units");
    let none = read("a.ts", &FEET.replace("AXIS_UNIT", "AXIS_LESS"));
    says(&none, "names no unit");
}

#[test]
fn surfaces_in_degrees_are_metres_as_rasters_are() {
    let degrees = "x,y,depth\n8.0,60.0,1500\n8.01,60.0,1510\n8.0,60.01,1520\n8.01,60.01,1530\n";
    let file = read("a.csv", degrees);
    says(&file, "can only be degrees");
    let latitude = file.latitude.unwrap();
    assert!((latitude - 60.005).abs() < 1e-5);
    let all = points(&file.surfaces[0]);
    let east = all.iter().map(|p| p.x).fold(f64::NEG_INFINITY, f64::max)
        - all.iter().map(|p| p.x).fold(f64::INFINITY, f64::min);
    assert!((east - 555.9).abs() < 0.5, "{east}");
    // A model of a few metres is not.
    let small = "x,y,depth\n0,0,15\n4,0,16\n0,4,17\n4,4,18\n";
    says(&read("a.csv", small), "taken as metres");
}
