//! Corner-point grids and properties of Eclipse's files, text and binary.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

use antumbra_subsurface::corner_point::{CellProperty, CornerPointGrid};
use antumbra_subsurface::read::{self, GridFile, ReadOptions};
use antumbra_subsurface::{BrickSource, SubsurfaceError};
use glam::DVec3;
use proptest::prelude::*;

#[path = "read_support/eclipse.rs"]
mod support;
use support::{INACTIVE, binary, porosity, results, text};

fn grid(name: &str, bytes: &[u8]) -> Result<GridFile, SubsurfaceError> {
    let options = ReadOptions {
        max_memory: Some(64 << 20),
        ..ReadOptions::default()
    };
    read::grid_file_from_bytes(Path::new(name), bytes, &options)
}

fn property(
    grid: &CornerPointGrid,
    name: &str,
    bytes: &[u8],
    wanted: Option<&str>,
) -> Result<CellProperty, String> {
    let options = ReadOptions::default();
    let read = read::property_of_from_bytes(grid, Path::new(name), bytes, wanted, &options);
    read.map_err(|error| error.to_string())
}

fn refused(name: &str, bytes: &[u8], word: &str) {
    let error = grid(name, bytes).unwrap_err().to_string();
    assert!(error.contains(word), "`{error}` does not say `{word}`");
}

#[test]
fn a_text_grid_lies_on_the_map_as_its_axes_say() {
    let GridFile { grid, notes } = grid("a.grdecl", text("METRES").as_bytes()).unwrap();
    assert_eq!(grid.size(), [2, 3, 2]);
    assert_eq!(grid.active_cells(), 11);
    assert!(notes.is_empty(), "{notes:?}");
    // The first cell of the upper layer: south-west in the grid, whose origin is at (1000, 5000).
    let corners = grid.corners([0, 0, 1]).unwrap();
    assert_eq!(corners[4], DVec3::new(1000.0, -1500.0, -5000.0));
    assert_eq!(corners[0], DVec3::new(1000.0, -1510.0, -5000.0));
    assert_eq!(corners[5], DVec3::new(1100.0, -1500.0, -5000.0));
    assert_eq!(corners[6], DVec3::new(1000.0, -1500.0, -5100.0));
    // Beyond the fault.
    let corners = grid.corners([1, 0, 1]).unwrap();
    assert_eq!(corners[4], DVec3::new(1100.0, -1540.0, -5000.0));
    assert!(!grid.is_active([0, 0, 0]) && grid.is_active([0, 0, 1]));
}

#[test]
fn feet_are_taken_to_metres_but_the_maps_axes_stay() {
    let GridFile { grid, notes } = grid("a.grdecl", text("FEET").as_bytes()).unwrap();
    let corners = grid.corners([1, 0, 1]).unwrap();
    let expected = DVec3::new(1000.0 + 30.48, -1540.0 * 0.3048, -5000.0);
    assert!(corners[4].distance(expected) < 1e-3, "{}", corners[4]);
    assert!(notes.iter().any(|note| note.contains("feet")), "{notes:?}");
}

#[test]
fn axes_on_the_map_are_in_the_unit_that_is_told_or_said_or_in_metres_with_a_note() {
    let without = text("FEET").replace("MAPUNITS\n'METRES  ' /\n", "");
    let west = |text: &str, units: &str| {
        let options = ReadOptions {
            units: units.parse().unwrap_or_default(),
            ..ReadOptions::default()
        };
        let read = read::grid_file_from_bytes(Path::new("a.grdecl"), text.as_bytes(), &options);
        let GridFile { grid, notes } = read.unwrap();
        (grid.corners([0, 0, 1]).unwrap()[4].x, notes.join("; "))
    };
    let (x, notes) = west(&without, "");
    assert!((x - 1000.0).abs() < 1e-3, "{x}");
    assert!(notes.contains("MAPUNITS"), "{notes}");
    let (x, notes) = west(&without, "ft");
    assert!((x - 304.8).abs() < 1e-3, "{x}");
    assert!(!notes.contains("MAPUNITS"), "{notes}");
    let feet = text("FEET").replace("'METRES  '", "FEET");
    assert!((west(&feet, "").0 - 304.8).abs() < 1e-3);
    // Units that are not known are quoted, once for each keyword.
    let cubits = text("CUBITS").replace("'METRES  '", "CUBITS");
    let (_, notes) = west(&cubits, "");
    assert_eq!(notes.matches("`CUBITS`").count(), 2, "{notes}");
}

#[test]
fn a_binary_grid_is_the_same_on_the_map() {
    let of_text = grid("a.grdecl", text("METRES").as_bytes()).unwrap().grid;
    let of_binary = grid("a.EGRID", &binary()).unwrap().grid;
    // Told by what it holds as well.
    assert_eq!(grid("nameless", &binary()).unwrap().grid, of_binary);
    let moved = DVec3::new(1000.0, 0.0, -5000.0);
    for (i, j, k) in [(0, 0, 0), (1, 2, 1), (0, 1, 1)] {
        let [a, b] = [&of_text, &of_binary].map(|grid| grid.corners([i, j, k]).unwrap());
        for (a, b) in a.into_iter().zip(b) {
            assert!(a.distance(b + moved) < 1e-3);
        }
        assert_eq!(of_text.is_active([i, j, k]), of_binary.is_active([i, j, k]));
    }
    // The first length of a little-endian file, without the keyword that should follow.
    let little = grid("a.EGRID", &[16, 0, 0, 0]).unwrap_err();
    assert!(little.to_string().contains("keyword"));
}

#[test]
fn grids_become_horizons() {
    let options = ReadOptions::default();
    for (name, bytes) in [
        ("a.grdecl", text("METRES").into_bytes()),
        ("a.egrid", binary()),
    ] {
        let surfaces =
            read::surfaces_from_bytes(Path::new(name), &bytes, &options, &mut |_, _| ()).unwrap();
        let names: Vec<_> = surfaces
            .iter()
            .map(|surface| surface.name.as_str())
            .collect();
        assert_eq!(
            names,
            [
                "a: top of layer 1",
                "a: top of layer 2",
                "a: base of layer 2"
            ]
        );
        assert_eq!(surfaces[0].geometry.triangle_count(), 12);
        // The fault is a gap: its columns share no vertex.
        assert_eq!(surfaces[0].geometry.positions.len(), 16);
        let up = surfaces[0]
            .geometry
            .normals
            .iter()
            .all(|normal| normal[1] > 0.0);
        assert!(up);
    }
}

#[test]
fn properties_go_with_their_cells() {
    let grid = grid("a.egrid", &binary()).unwrap().grid;
    // The third index is fastest here, and grows upwards.
    let at = |values: &[f32], [i, j, k]: [usize; 3]| values[(i * 3 + j) * 2 + k];
    let expected = porosity();
    let of_text = property(&grid, "a.grdecl", text("METRES").as_bytes(), Some("poro")).unwrap();
    assert_eq!(of_text.name, "PORO");
    let of_results = property(&grid, "a.INIT", &results(), Some("PORO")).unwrap();
    for (cell, &value) in expected.iter().enumerate() {
        let (i, j, layer) = (cell % 2, cell / 2 % 3, cell / 6);
        let place = [i, j, 1 - layer];
        assert_eq!(at(&of_text.values, place), value);
        match cell == INACTIVE {
            true => assert!(at(&of_results.values, place).is_nan()),
            false => assert_eq!(at(&of_results.values, place), value),
        }
    }
    let whole = property(&grid, "a.INIT", &results(), Some("PORV")).unwrap();
    assert_eq!(at(&whole.values, [0, 0, 0]), expected[INACTIVE]);
    let volume = grid.volume(&of_results, [8, 8, 8], &mut |_, _| ()).unwrap();
    assert_eq!(volume.layout().range, [0.1, 0.1 + 0.01 * 11.0]);

    let many = property(&grid, "a.INIT", &results(), None).unwrap_err();
    assert!(
        many.contains("PORO, PORV") && many.contains("--property"),
        "{many}"
    );
    let none = property(&grid, "a.grdecl", text("METRES").as_bytes(), Some("PERMX")).unwrap_err();
    assert!(none.contains("PORO, NTG"), "{none}");
    let only = "PORO\n12*0.25 /\n";
    let only = property(&grid, "poro.inc", only.as_bytes(), None).unwrap();
    assert_eq!(only.values, [0.25; 12]);
}

#[test]
fn keywords_with_words_among_their_values_hide_no_property() {
    let grid = grid("a.egrid", &binary()).unwrap().grid;
    let words = "COORDSYS\n 1 2 'INCOMP  ' 3* 'FLAT' /\nPINCH\n 0.001 GAP 1* TOPBOT TOP /\n\
        JFUNC\n 'WATER' 22.0 /\nPORO\n12*0.25 /\nBOX\n 1 2 1 3 1 x /\n";
    for wanted in [Some("poro"), None] {
        let found = property(&grid, "poro.inc", words.as_bytes(), wanted).unwrap();
        assert_eq!(
            (found.name.as_str(), &found.values),
            ("PORO", &vec![0.25; 12])
        );
    }
    // As many values as cells, one of them a word.
    let wrong = "PORO\n11*0.25 'x' /\n";
    let error = property(&grid, "poro.inc", wrong.as_bytes(), None).unwrap_err();
    assert!(error.contains("none with a value"), "{error}");
    let error = property(&grid, "poro.inc", wrong.as_bytes(), Some("PORO")).unwrap_err();
    assert!(error.contains("no number"), "{error}");
}

#[test]
fn records_hold_whole_values_and_are_paid_for() {
    let torn = support::keyword("COORD", "REAL", &[vec![0; 3], vec![0; 5]], 1);
    refused("a.egrid", &torn, "records do not fit");
    // A record for each value of a keyword that nothing reads.
    let short = support::keyword("OTHER", "REAL", &support::reals(&[0.0; 100_000]), 1);
    let options = ReadOptions {
        max_memory: Some(3 << 20),
        ..ReadOptions::default()
    };
    let error = read::grid_file_from_bytes(Path::new("a.egrid"), &short, &options).unwrap_err();
    let error = error.to_string();
    assert!(error.contains("the records of OTHER"), "{error}");
    let few = support::keyword("OTHER", "REAL", &support::reals(&[0.0; 100_000]), 1000);
    let error = read::grid_file_from_bytes(Path::new("a.egrid"), &few, &options).unwrap_err();
    assert!(error.to_string().contains("how many cells"), "{error}");
}

#[test]
fn what_is_wrong_with_a_grid_is_named() {
    let good = text("METRES");
    let replaced = |from: &str, to: &str| {
        assert!(good.contains(from));
        good.replace(from, to).into_bytes()
    };
    refused(
        "a.grdecl",
        &replaced("SPECGRID\n 2 3 2", "SPECGRID\n 2 3 3"),
        "ZCORN",
    );
    refused(
        "a.grdecl",
        &replaced("SPECGRID\n 2 3 2", "SPECGRID\n 2 3 0"),
        "counts of cells",
    );
    refused(
        "a.grdecl",
        &replaced("6*1", "600000000000*1"),
        "ACTNUM has more",
    );
    refused("a.grdecl", &replaced("6*1", "x*1"), "no number");
    refused(
        "a.grdecl",
        &replaced("SPECGRID\n 2 3 2", "SPECGRID\n 90000 90000 90000"),
        "memory",
    );
    refused("a.grdecl", &replaced("SPECGRID", "SOMETHING"), "SPECGRID");
    refused("a.grdecl", b"", "SPECGRID");
    let included = replaced("ECHO\n", "INCLUDE\n 'more.inc' /\n");
    let GridFile { notes, .. } = grid("a.grdecl", &included).unwrap();
    assert!(notes.iter().any(|note| note.contains("more.inc")));

    let whole = binary();
    for end in [5, 30, 900, whole.len() - 1] {
        assert!(grid("a.egrid", &whole[..end]).is_err(), "{end}");
    }
    let unstructured = support::keyword("GRIDHEAD", "INTE", &vec![vec![0, 0, 0, 2]; 10], 1000);
    refused("a.egrid", &unstructured, "type 2");
    refused("a.egrid", &results(), "how many cells");
    let parameter = grid("a.asc", b"ncols 2").unwrap_err().to_string();
    assert!(parameter.contains("no grid of cells"), "{parameter}");
}

proptest! {
    /// Damaged grids give a grid or an error.
    #[test]
    fn damage_is_survived(at in any::<prop::sample::Index>(), byte in any::<u8>(), cut in any::<prop::sample::Index>(), is_cut in any::<bool>()) {
        for (name, mut bytes) in [("a.grdecl", text("METRES").into_bytes()), ("a.egrid", binary())] {
            let place = at.index(bytes.len());
            bytes[place] = byte;
            if is_cut {
                bytes.truncate(cut.index(bytes.len()));
            }
            if let Ok(file) = grid(name, &bytes) {
                let _ = property(&file.grid, "a.INIT", &results(), None);
            }
        }
    }
}
