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
    // All bytes of every number turned around: a little-endian file has the same lengths, but its texts as they are.
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
