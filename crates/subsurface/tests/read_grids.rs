//! Corner-point grids: faults are gaps, inactive cells are holes, every encoding gives the same result; properties
//! fill volumes.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

use antumbra_subsurface::corner_point::{CellProperty, CornerPointGrid};
use antumbra_subsurface::read::{self, ReadOptions, ZPositive};
use antumbra_subsurface::{BrickSource, SubsurfaceError, Surface};
use glam::{DVec3, Vec3};

#[path = "read_support/roff.rs"]
mod roff;
use roff::{GridFile, Way, parameter};

fn surfaces(bytes: &[u8]) -> Vec<Surface> {
    let read = read::surfaces_from_bytes(
        Path::new("field.roff"),
        bytes,
        &ReadOptions::default(),
        &mut |_, _| (),
    );
    read.unwrap()
}

fn grid(bytes: &[u8]) -> CornerPointGrid {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), bytes).unwrap();
    read::grid(file.path(), &ReadOptions::default()).unwrap()
}

fn points(surface: &Surface) -> Vec<DVec3> {
    let world = |p: &[f32; 3]| surface.origin + Vec3::from(*p).as_dvec3();
    surface.geometry.positions.iter().map(world).collect()
}

/// Layers 10 m high from -2000 up, level.
fn level(_: [i32; 3], [_, _, k]: [i32; 3]) -> f64 {
    -2000.0 + 10.0 * f64::from(k)
}

/// The same with a throw of 30 m downwards from column 2 on.
fn faulted(cell: [i32; 3], node: [i32; 3]) -> f64 {
    level(cell, node) - if cell[0] >= 2 { 30.0 } else { 0.0 }
}

#[test]
fn each_layer_border_is_a_horizon_from_the_top_down() {
    let surfaces = surfaces(&GridFile::new([3, 2, 2]).write(level));
    let names: Vec<_> = surfaces
        .iter()
        .map(|surface| surface.name.as_str())
        .collect();
    assert_eq!(
        names,
        [
            "field: top of layer 1",
            "field: top of layer 2",
            "field: base of layer 2"
        ]
    );
    for (surface, height) in surfaces.iter().zip([-1980.0, -1990.0, -2000.0]) {
        assert_eq!(surface.geometry.triangle_count(), 12);
        let points = points(surface);
        assert_eq!(points.len(), 12);
        for (point, plan) in points.iter().zip(&surface.plan) {
            let (i, j) = (f64::from(plan[0]) * 3.0, f64::from(plan[1]) * 2.0);
            let expected = DVec3::new(460_000.0 + 100.0 * i, height, -5_930_000.0 - 100.0 * j);
            assert!(point.distance(expected) < 1e-2, "{point} is not {expected}");
        }
        assert!(
            surface
                .geometry
                .normals
                .iter()
                .all(|normal| *normal == [0.0, 1.0, 0.0])
        );
    }
}

#[test]
fn a_faults_throw_is_a_gap() {
    let surfaces = surfaces(&GridFile::new([4, 3, 1]).write(faulted));
    for surface in &surfaces {
        // The pillars of the fault have two nodes each.
        let points = points(surface);
        assert_eq!(points.len(), 5 * 4 + 4);
        let on_fault = points
            .iter()
            .filter(|point| (point.x - 460_200.0).abs() < 1.0);
        let heights: Vec<_> = on_fault.map(|point| point.y).collect();
        assert_eq!(heights.len(), 8);
        let high = heights.iter().copied().fold(f64::MIN, f64::max);
        let low = heights.iter().copied().fold(f64::MAX, f64::min);
        assert!((high - low - 30.0).abs() < 1e-3);
        for [a, b, c] in surface
            .geometry
            .triangles()
            .map(|t| surface.geometry.corners(t).unwrap())
        {
            assert!(a.y == b.y && b.y == c.y, "a triangle bridges the fault");
        }
        assert_eq!(surface.geometry.triangle_count(), 24);
    }
}

#[test]
fn corners_that_agree_within_a_millimetre_are_one() {
    let nearly =
        |cell: [i32; 3], node| level(cell, node) + 4e-4 * f64::from((cell[0] + cell[1]) % 2);
    let surfaces = surfaces(&GridFile::new([3, 3, 1]).write(nearly));
    assert_eq!(surfaces[0].geometry.positions.len(), 16);
}

#[test]
fn every_way_of_writing_says_the_same() {
    let file = GridFile {
        active: Some(|cell| cell != [1, 1, 0]),
        ..GridFile::new([3, 2, 2])
    };
    let expected = surfaces(&file.write(faulted));
    for way in [Way::Big, Way::Ascii] {
        let file = GridFile { way, ..file };
        assert_eq!(surfaces(&file.write(faulted)), expected, "{way:?}");
    }
    let file = GridFile { split: 8, ..file };
    assert_eq!(surfaces(&file.write(faulted)), expected);
    let expected = surfaces(&GridFile { split: 4, ..file }.write(level));
    for split in [0, 1, 2] {
        assert_eq!(
            surfaces(&GridFile { split, ..file }.write(level)),
            expected,
            "{split}"
        );
    }
}

#[test]
fn a_border_shows_the_top_of_what_is_below_it() {
    // Layers are 2 m apart: only two or eight heights per node can express this.
    let apart = |cell: [i32; 3], node| level(cell, node) + 2.0 * f64::from(cell[2]);
    for split in [2, 8] {
        let surfaces = surfaces(
            &GridFile {
                split,
                ..GridFile::new([2, 2, 2])
            }
            .write(apart),
        );
        let heights: Vec<_> = surfaces.iter().map(|surface| surface.origin.y).collect();
        assert_eq!(heights, [-1978.0, -1990.0, -2000.0]);
    }
}

#[test]
fn inactive_cells_are_holes_and_their_active_neighbours_still_shown() {
    let file = |active| GridFile {
        active: Some(active),
        ..GridFile::new([3, 3, 2])
    };
    let one = surfaces(&file(|cell| cell != [1, 1, 1]).write(level));
    let triangles: Vec<_> = one.iter().map(|s| s.geometry.triangle_count()).collect();
    assert_eq!(triangles, [16, 18, 18]);
    assert_eq!(one[0].geometry.positions.len(), 16);
    let column = surfaces(&file(|cell| [cell[0], cell[1]] != [0, 0]).write(level));
    assert!(
        column
            .iter()
            .all(|s| s.geometry.triangle_count() == 16 && s.geometry.positions.len() == 15)
    );
    let lower = surfaces(&file(|cell| cell[2] == 0).write(level));
    assert_eq!(lower.len(), 2, "the top of the inactive layer has no cell");
    let none = file(|_| false).write(level);
    let read = read::surfaces_from_bytes(
        Path::new("f.roff"),
        &none,
        &ReadOptions::default(),
        &mut |_, _| (),
    );
    assert!(read.unwrap_err().to_string().contains("no cell is active"));
}

#[test]
fn corners_slide_along_slanted_pillars() {
    // A pillar of 1000 m leans 500 m east: 10 m up is 5 m east.
    let surfaces = surfaces(
        &GridFile {
            slant: 500.0,
            ..GridFile::new([1, 1, 2])
        }
        .write(level),
    );
    let west = |surface: &Surface| {
        points(surface)
            .iter()
            .fold(f64::MAX, |west, p| west.min(p.x))
    };
    let wests: Vec<_> = surfaces
        .iter()
        .map(|surface| west(surface).round())
        .collect();
    assert_eq!(wests, [460_010.0, 460_005.0, 460_000.0]);
}

#[test]
fn a_mirrored_grid_still_looks_up() {
    let surfaces = surfaces(
        &GridFile {
            scale_x: -1.0,
            ..GridFile::new([2, 3, 1])
        }
        .write(faulted),
    );
    for surface in surfaces {
        let corners = |triangle| surface.geometry.corners(triangle).unwrap();
        let up = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).y > 0.0;
        assert!(
            surface
                .geometry
                .triangles()
                .all(|triangle| up(corners(triangle)))
        );
    }
}

#[test]
fn depths_can_be_told_to_be_elevations() {
    let bytes = GridFile::new([1, 1, 1]).write(level);
    let options = ReadOptions {
        z_positive: Some(ZPositive::Up),
        ..ReadOptions::default()
    };
    let read =
        read::surfaces_from_bytes(Path::new("f.roff"), &bytes, &options, &mut |_, _| ()).unwrap();
    assert_eq!(read[0].origin.y, 1990.0);
}

#[test]
fn undefined_values_of_every_kind_are_nan() {
    let cases = [
        ("int", [3.0, -999.0, 2e9, 7.0]),
        ("float", [0.25, -999.0, 1e33, 0.5]),
        ("double", [0.25, -999.0, 1e33, f64::NAN]),
        ("byte", [1.0, 255.0, 255.0, 254.0]),
    ];
    for ((kind, values), way) in cases
        .into_iter()
        .flat_map(|case| [Way::Little, Way::Big, Way::Ascii].map(|way| (case, way)))
    {
        if way == Way::Ascii && kind == "double" {
            continue; // ASCII has no word for NaN.
        }
        let property = read::property_from_bytes(
            Path::new("p.roff"),
            &parameter(way, [1, 2, 2], kind, &values),
        )
        .unwrap();
        assert_eq!((property.name.as_str(), property.size), ("PORO", [1, 2, 2]));
        assert_eq!(property.values[0], values[0] as f32);
        assert!(
            property.values[1].is_nan() && property.values[2].is_nan(),
            "{kind} {way:?}"
        );
        assert!(values[3].is_nan() || property.values[3] == values[3] as f32);
    }
}

fn property(size: [u32; 3], value: impl Fn(u32, u32, u32) -> f32) -> CellProperty {
    let [nx, ny, nz] = size;
    let cells = (0..nx).flat_map(|i| (0..ny).flat_map(move |j| (0..nz).map(move |k| (i, j, k))));
    CellProperty {
        name: "P".into(),
        size,
        values: cells.map(|(i, j, k)| value(i, j, k)).collect(),
    }
}

#[test]
fn a_sample_has_the_value_of_the_cell_it_lies_in() {
    let grid = grid(
        &GridFile {
            active: Some(|cell| cell[..2] != [0, 0]),
            ..GridFile::new([4, 3, 2])
        }
        .write(faulted),
    );
    let value = |i: u32, j: u32, k: u32| (i * 100 + j * 10 + k) as f32;
    let property = property([4, 3, 2], value);
    let volume = grid
        .volume(&property, [40, 30, 50], &mut |_, _| ())
        .unwrap();
    let layout = *volume.layout();
    assert_eq!((layout.size, layout.range), ([40, 30, 50], [10.0, 321.0]));
    let mut known = 0;
    for (i, j, k) in
        (0..50).flat_map(|k| (0..30).flat_map(move |j| (0..40).map(move |i| (i, j, k))))
    {
        let at = layout.position(DVec3::new(f64::from(i), f64::from(j), f64::from(k)));
        let (east, north) = (
            ((at.x - 460_000.0) / 100.0) as u32,
            ((-at.z - 5_930_000.0) / 100.0) as u32,
        );
        let up = (at.y + 2000.0 + if east >= 2 { 30.0 } else { 0.0 }) / 10.0;
        let inside = (0.0..2.0).contains(&up) && [east, north] != [0, 0];
        let sample = volume.sample([i, j, k]).unwrap();
        assert_eq!(sample != 0, inside, "{i} {j} {k}");
        if let Some(found) = layout.value(sample) {
            let expected = value(east, north, up as u32);
            assert!(
                (found - expected).abs() <= 311.0 / 254.0 / 2.0 + 1e-3,
                "{found} {expected}"
            );
            known += 1;
        }
    }
    // 11 columns of 100 samples in plan, 20 samples per 50 metres of the box.
    assert_eq!(known, 11 * 100 * 20);
}

#[test]
fn a_volume_reads_as_bricks_that_repeat_the_last_samples() {
    let grid = grid(&GridFile::new([2, 2, 2]).write(level));
    let volume = grid
        .volume(
            &property([2, 2, 2], |_, _, k| k as f32),
            [33, 5, 7],
            &mut |_, _| (),
        )
        .unwrap();
    assert_eq!(volume.layout().bricks(), [2, 1, 1]);
    let mut samples = vec![0; volume.layout().brick_bytes()];
    for brick in 0..2 {
        volume.read([brick, 0, 0], &mut samples).unwrap();
        for (index, sample) in samples.iter().enumerate() {
            let [x, y, z] = [index % 32, index / 32 % 32, index / 1024].map(|at| at as u32);
            let at = [(brick * 32 + x).min(32), y.min(4), z.min(6)];
            assert_eq!(Some(*sample), volume.sample(at));
        }
    }
    assert!(matches!(
        volume.read([2, 0, 0], &mut samples),
        Err(SubsurfaceError::NoSuchBrick { .. })
    ));
    assert!(matches!(
        volume.read([0, 0, 0], &mut [0; 5]),
        Err(SubsurfaceError::BufferLength { .. })
    ));
    assert_eq!(volume.sample([33, 0, 0]), None);
}

#[test]
fn volumes_that_cannot_be_are_refused() {
    let bytes = GridFile::new([2, 2, 2]).write(level);
    let grid = grid(&bytes);
    let good = property([2, 2, 2], |_, _, _| 1.0);
    let refused = |property: &CellProperty, size: [u32; 3], word: &str| {
        let error = grid
            .volume(property, size, &mut |_, _| ())
            .unwrap_err()
            .to_string();
        assert!(error.contains(word), "{error}");
    };
    refused(&property([2, 2, 3], |_, _, _| 1.0), [8, 8, 8], "cells");
    refused(
        &CellProperty {
            values: vec![1.0],
            ..good.clone()
        },
        [8, 8, 8],
        "cells",
    );
    refused(
        &property([2, 2, 2], |_, _, _| f32::NAN),
        [8, 8, 8],
        "no active cell",
    );
    refused(&good, [8, 0, 8], "at least one");
    refused(&good, [u32::MAX; 3], "at most");
    refused(&good, [1 << 20, 1 << 12, 1], "at most");
    let one = grid.volume(&good, [4, 4, 4], &mut |_, _| ()).unwrap();
    let [low, high] = one.layout().range;
    assert!(low == 1.0 && high > low, "a range of one value still rises");
}
