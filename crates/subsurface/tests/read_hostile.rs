//! Files that are truncated, declare a wrong size or contain noise give an error with a location, and never a panic.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

use antumbra_subsurface::read::{self, ReadOptions};
use antumbra_subsurface::{SubsurfaceError, Surface, SurfaceKind};
use proptest::prelude::*;
use proptest::sample::Index;

#[path = "read_support/files.rs"]
mod files;
#[path = "read_support/roff.rs"]
mod roff;
use roff::{GridFile, Roff, Way, parameter};

fn read(name: &str, bytes: &[u8]) -> Result<Vec<Surface>, SubsurfaceError> {
    let options = ReadOptions::default();
    read::surfaces_from_bytes(Path::new(name), bytes, &options, &mut |_, _| ())
}

fn refused(name: &str, bytes: &[u8], word: &str) {
    let error = read(name, bytes).unwrap_err().to_string();
    assert!(error.contains(word), "`{error}` does not say `{word}`");
}

fn height([i, j, k]: [i32; 3], _: [i32; 3]) -> f64 {
    -2000.0 + f64::from(10 * k + i * j)
}

fn grid(way: Way) -> Vec<u8> {
    let active = Some((|cell| cell != [0, 0, 0]) as fn([i32; 3]) -> bool);
    GridFile {
        way,
        active,
        ..GridFile::new([2, 2, 2])
    }
    .write(height)
}

/// One valid file of each kind.
fn all() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("a.gri", files::irap(4, 3, &files::depths(), 30.0)),
        ("a.irap", files::irap_ascii().into_bytes()),
        ("a.asc", files::esri().into_bytes()),
        ("a.tif", files::geotiff(&[1, 1, 0, 1, 1025, 0, 1, 1])),
        ("a.ts", files::gocad().into_bytes()),
        ("a.json", files::faultroom().into_bytes()),
        (
            "a.csv",
            b"x,y,z,name\n0,0,5,a\n10,0,5,a\n0,10,5,a\n9,9,1,a\n".to_vec(),
        ),
        ("a.roff", grid(Way::Little)),
        ("b.roff", grid(Way::Big)),
        ("c.roff", grid(Way::Ascii)),
    ]
}

/// Asserts what holds for every surface from every reader.
fn assert_sound(surfaces: &[Surface]) {
    assert!(!surfaces.is_empty());
    for surface in surfaces {
        assert_eq!(surface.geometry.problem(), None);
        assert!(surface.origin.is_finite());
        assert!(surface.geometry.triangle_count() > 0);
        assert_eq!(
            surface.geometry.normals.len(),
            surface.geometry.positions.len()
        );
        assert!(
            surface
                .plan
                .as_flattened()
                .iter()
                .all(|at| (0.0..=1.0).contains(at))
        );
    }
}

#[test]
fn a_truncated_binary_file_is_an_error_wherever_it_ends() {
    for (name, bytes) in all() {
        assert_sound(&read(name, &bytes).unwrap());
        let is_text = std::str::from_utf8(&bytes).is_ok();
        // The last word of a ROFF file carries no data.
        let ends = bytes.len() - if bytes.starts_with(b"roff-bin") { 7 } else { 0 };
        for end in 0..ends {
            match read(name, &bytes[..end]) {
                // A truncated table of picks is still a table of picks.
                Ok(surfaces) if is_text => assert_sound(&surfaces),
                Ok(_) => panic!("{name} was read from its first {end} bytes"),
                Err(error) => assert!(matches!(error, SubsurfaceError::Format { .. })),
            }
        }
    }
    let property = parameter(Way::Little, [2, 2, 2], "float", &[1.0; 8]);
    for end in 0..property.len() - 7 {
        assert!(read::property_from_bytes(Path::new("p.roff"), &property[..end]).is_err());
    }
}

#[test]
fn sizes_that_lie_are_found_before_memory_is_asked_for() {
    let values = files::depths();
    for (columns, rows) in [(i32::MAX, i32::MAX), (1 << 20, 1 << 20), (4, 4)] {
        refused(
            "a.gri",
            &files::irap(columns, rows, &values, 0.0),
            "declare",
        );
    }
    for (columns, rows) in [(0, 3), (-4, 3), (4, 1), (4, i32::MIN)] {
        refused(
            "a.gri",
            &files::irap(columns, rows, &values, 0.0),
            "at least 2 x 2",
        );
    }
    for size in [
        "4294967295",
        "100000",
        "1",
        "0",
        "-4",
        "1e300",
        "nan",
        "4.5",
    ] {
        let bad = |text: String, from: &str| text.replacen(from, &from.replace('4', size), 1);
        let irap = bad(files::irap_ascii(), "\n4 0.0");
        assert!(read("a.irap", irap.as_bytes()).is_err(), "{size}");
        let esri = bad(files::esri(), "ncols 4");
        assert!(read("a.asc", esri.as_bytes()).is_err(), "{size}");
    }
    let mut tiff = files::geotiff(&[]);
    let width = tiff
        .windows(4)
        .position(|tag| tag == [0, 1, 4, 0] || tag == [0, 1, 3, 0]);
    let at = width.expect("the tag of the width") + 8;
    tiff[at..at + 4].copy_from_slice(&u32::MAX.to_le_bytes());
    refused("a.tif", &tiff, "declares");
}

#[test]
fn roff_arrays_must_fit_the_dimensions_and_the_file() {
    let good = grid(Way::Little);
    let after = |key: &[u8]| {
        let at = good.windows(key.len()).position(|window| window == key);
        at.unwrap() + key.len()
    };
    let with = |at: usize, value: i32| {
        let mut bad = good.clone();
        bad[at..at + 4].copy_from_slice(&value.to_le_bytes());
        bad
    };
    for key in [&b"int\0nX\0"[..], b"int\0nY\0", b"int\0nZ\0"] {
        refused("a.roff", &with(after(key), 3), "by the dimensions");
        refused("a.roff", &with(after(key), 15_000_000), "by the dimensions");
        for value in [0, -1, i32::MIN, i32::MAX] {
            refused("a.roff", &with(after(key), value), "at least one cell");
        }
    }
    let arrays: [&[u8]; 3] = [
        b"array\0float\0data\0",
        b"array\0byte\0splitEnz\0",
        b"array\0bool\0data\0",
    ];
    for key in arrays {
        refused("a.roff", &with(after(key), i32::MAX), "the file ends");
        refused("a.roff", &with(after(key), -1), "length of -1");
    }
    refused("a.roff", &with(after(b"byteswaptest\0"), 7), "byteswaptest");
    let mut split = good.clone();
    split[after(b"splitEnz\0") + 4] = 3;
    refused("a.roff", &split, "splitEnz 0 is 3");
    split[after(b"splitEnz\0") + 4] = 8;
    refused("a.roff", &split, "by splitEnz");
    let text = String::from_utf8(grid(Way::Ascii)).unwrap();
    let long = text.replacen("array bool data 8", "array bool data 999999999999", 1);
    refused("b.roff", long.as_bytes(), "999999999999 values");
}

#[test]
fn roff_tags_out_of_order_or_missing_are_named() {
    for way in [Way::Little, Way::Ascii] {
        let mut nested = Roff::new(way, "grid");
        nested.word("tag").word("a").word("tag").word("b");
        refused(
            "a.roff",
            &nested.end(),
            "`tag` where a key or `endtag` should be",
        );
        let mut loose = Roff::new(way, "grid");
        loose.int("nX", 1);
        refused("a.roff", &loose.end(), "`int` where a tag should begin");
        refused(
            "a.roff",
            &Roff::new(way, "grid").end(),
            "`dimensions` with key `nX` is missing",
        );
        let sizes = Roff::new(way, "grid").dimensions([1, 1, 1]).end();
        refused("a.roff", &sizes, "`cornerLines` with key `data` is missing");
        refused(
            "a.roff",
            &parameter(way, [1, 1, 1], "float", &[1.0]),
            "parameter",
        );
        let mut many = Roff::new(way, "grid");
        many.word("tag").word("many");
        for _ in 0..70_000 {
            many.int("n", 1);
        }
        refused("a.roff", &many.word("endtag").end(), "more than 65536 keys");
        let short = parameter(way, [2, 2, 2], "float", &[1.0; 7]);
        let error = read::property_from_bytes(Path::new("p.roff"), &short).unwrap_err();
        assert!(error.to_string().contains("should have 8"));
    }
}

#[test]
fn only_undefined_nodes_are_an_error_that_says_so() {
    refused(
        "a.gri",
        &files::irap(4, 3, &[9_999_900.0; 12], 0.0),
        "undefined",
    );
    refused(
        "a.gri",
        &files::irap(4, 3, &[f32::NAN; 12], 0.0),
        "undefined",
    );
    refused(
        "a.gri",
        &files::irap(4, 3, &[f32::NEG_INFINITY; 12], 0.0),
        "undefined",
    );
    let head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    refused(
        "a.asc",
        format!("{head}-9999 nan inf -9999").as_bytes(),
        "undefined",
    );
    let nothing = GridFile::new([2, 2, 2]).write(|_, _| f64::NAN);
    refused(
        "a.roff",
        &nothing,
        "no cell is active and has all its corners",
    );
    let property = parameter(Way::Little, [1, 1, 2], "int", &[-999.0; 2]);
    let error = read::property_from_bytes(Path::new("p.roff"), &property).unwrap_err();
    assert!(error.to_string().contains("undefined"));
}

#[test]
fn places_that_are_none_are_refused_or_holes() {
    let mut turned = files::irap(4, 3, &files::depths(), f32::NAN);
    refused("a.gri", &turned, "beyond");
    turned = files::irap(4, 3, &files::depths(), 0.0);
    turned[12..16].copy_from_slice(&f32::INFINITY.to_be_bytes());
    refused("a.gri", &turned, "beyond");
    let one = |cell: [i32; 3], node| match cell {
        [0, 0, _] => f64::INFINITY,
        _ => height(cell, node),
    };
    let surfaces = read("a.roff", &GridFile::new([2, 2, 1]).write(one)).unwrap();
    assert_sound(&surfaces);
    assert!(
        surfaces
            .iter()
            .all(|surface| surface.geometry.triangle_count() == 6)
    );
    let far = files::faultroom().replace("460000.0", "1e300");
    refused("a.json", far.as_bytes(), "no place");
    let head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\n";
    refused(
        "a.asc",
        format!("{head}cellsize 0\n1 2 3 4").as_bytes(),
        "no area",
    );
    refused(
        "a.asc",
        format!("{head}cellsize inf\n1 2 3 4").as_bytes(),
        "beyond",
    );
    refused("a.asc", format!("{head}1 2 3 4").as_bytes(), "cellsize");
    refused(
        "a.asc",
        format!("{head}cellsize 1\n1 2 3 4 5").as_bytes(),
        "follows after all",
    );
    refused(
        "a.asc",
        format!("{head}cellsize 1\n1 2 x 4").as_bytes(),
        "no number",
    );
}

#[test]
fn files_that_are_no_files_are_said_to_be_none() {
    let read = |path: &Path| read::surfaces(path, &ReadOptions::default(), &mut |_, _| ());
    let folder = tempfile::tempdir().unwrap();
    let missing = read(&folder.path().join("missing.gri")).unwrap_err();
    assert!(matches!(
        missing,
        SubsurfaceError::File { action: "read", .. }
    ));
    let error = read(folder.path()).unwrap_err();
    assert!(error.to_string().contains("directory"), "{error}");
    let empty = folder.path().join("empty.gri");
    std::fs::write(&empty, []).unwrap();
    assert!(matches!(read(&empty), Err(SubsurfaceError::Format { .. })));
    let huge = folder.path().join("huge.gri");
    let file = std::fs::File::create(&huge).unwrap();
    if file.set_len(read::MAX_FILE_BYTES + 1).is_ok() {
        assert!(read(&huge).unwrap_err().to_string().contains("larger than"));
    }
}

proptest! {
    #[test]
    fn noise_never_panics(which in any::<Index>(), noise in prop::collection::vec(any::<u8>(), 0..300), keeps_magic: bool) {
        let all = all();
        let (name, bytes) = which.get(&all);
        let head = if keeps_magic { &bytes[..bytes.len().min(16)] } else { &[] };
        if let Ok(surfaces) = read(name, &[head, &noise].concat()) {
            assert_sound(&surfaces);
        }
        let _ = read::property_from_bytes(Path::new(name), &[head, &noise].concat());
    }

    #[test]
    fn changed_files_never_panic_nor_give_broken_surfaces(
        which in any::<Index>(),
        changes in prop::collection::vec((any::<Index>(), any::<u8>()), 1..8),
        cut in prop::option::of((any::<Index>(), any::<Index>())),
        as_horizon: bool,
    ) {
        let all = all();
        let (name, bytes) = which.get(&all);
        let mut bytes = bytes.clone();
        for (at, byte) in changes {
            *at.get_mut(&mut bytes) = byte;
        }
        if let Some((from, to)) = cut {
            let (from, to) = (from.index(bytes.len()), to.index(bytes.len()));
            bytes.drain(from.min(to)..from.max(to));
        }
        let kind = as_horizon.then_some(SurfaceKind::Horizon);
        let options = ReadOptions { kind, ..ReadOptions::default() };
        if let Ok(surfaces) = read::surfaces_from_bytes(Path::new(name), &bytes, &options, &mut |_, _| ()) {
            assert_sound(&surfaces);
        }
    }

    #[test]
    fn changed_numbers_in_grids_give_sound_surfaces_and_volumes(
        heights in prop::collection::vec(prop_oneof![any::<f32>(), -3000_f32..0.0], 8),
    ) {
        let odd = |cell: [i32; 3], _: [i32; 3]| {
            let [i, j, k] = cell.map(|at| (at + 1) as usize);
            f64::from(heights[(i + j * 2 + k * 3) % heights.len()])
        };
        let bytes = GridFile { slant: 100.0, ..GridFile::new([2, 2, 2]) }.write(odd);
        if let Ok(surfaces) = read("a.roff", &bytes) {
            assert_sound(&surfaces);
        }
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), &bytes).unwrap();
        let grid = read::grid(file.path(), &ReadOptions::default()).unwrap();
        let property = parameter(Way::Little, [2, 2, 2], "float", &[1.0; 8]);
        let property = read::property_from_bytes(Path::new("p.roff"), &property).unwrap();
        if let Ok(volume) = grid.volume(&property, [9, 8, 7], &mut |_, _| ()) {
            prop_assert!(volume.sample([8, 7, 6]).is_some());
        }
    }

    #[test]
    fn any_points_are_triangulated_upwards_without_overlap(
        points in prop::collection::vec((0_i32..12, 0_i32..12, -100_i32..100), 3..80),
        scale in prop_oneof![Just(1.0), Just(1e-3), Just(1e6), 0.1..100.0],
    ) {
        let mut text = "x,y,z\n".to_owned();
        for (x, y, z) in &points {
            text += &format!("{},{},{z}\n", f64::from(*x) * scale + 5e5, f64::from(*y) * scale + 6e6);
        }
        let options = ReadOptions { longest_edge: Some(f64::INFINITY), ..ReadOptions::default() };
        let read = read::surfaces_from_bytes(Path::new("p.csv"), text.as_bytes(), &options, &mut |_, _| ());
        if let Ok(surfaces) = read {
            assert_sound(&surfaces);
            let geometry = &surfaces[0].geometry;
            let area = |triangle| {
                let [a, b, c] = geometry.corners(triangle).unwrap();
                (b - a).cross(c - a).y / 2.0
            };
            let areas: Vec<_> = geometry.triangles().map(area).collect();
            prop_assert!(areas.iter().all(|area| *area > 0.0));
            // In sum no more than the box: each place is covered once.
            let bounds = geometry.bounds().unwrap();
            let size = bounds.max - bounds.min;
            prop_assert!(areas.iter().sum::<f64>() <= size.x * size.z * 1.001);
        }
    }
}
