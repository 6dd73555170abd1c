//! The real files of `data/` (`make data`), if present: surfaces agree with what is known of the files.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::PathBuf;

use antumbra_subsurface::read::{self, ReadOptions};
use antumbra_subsurface::{BrickSource, Surface, SurfaceKind};
use glam::DVec3;

/// `None`, with a printed note, if the file has not been fetched.
fn real(name: &str) -> Option<PathBuf> {
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data")).join(name);
    if !path.exists() {
        eprintln!("skipped: {} is not there (make data)", path.display());
        return None;
    }
    Some(path)
}

fn surfaces(name: &str) -> Option<Vec<Surface>> {
    let mut told = Vec::new();
    let read = read::surfaces(&real(name)?, &ReadOptions::default(), &mut |done, total| {
        told.push((done, total));
    });
    let surfaces = read.unwrap();
    let count = surfaces.len() as u64;
    assert_eq!(told.last(), Some(&(count, count)));
    for surface in &surfaces {
        let geometry = &surface.geometry;
        assert_eq!(geometry.problem(), None, "{}", surface.name);
        assert_eq!(geometry.normals.len(), geometry.positions.len());
        let is_horizon = surface.kind == SurfaceKind::Horizon;
        let plan = if is_horizon {
            geometry.positions.len()
        } else {
            0
        };
        assert_eq!(surface.plan.len(), plan);
        let inside = |at: &f32| (0.0..=1.0).contains(at);
        assert!(surface.plan.as_flattened().iter().all(inside));
        let bounds = geometry.bounds().unwrap();
        assert!(
            bounds.centre().length() < 50.0,
            "the origin is in the middle"
        );
        let up = |triangle| {
            let [a, b, c] = geometry.corners(triangle).unwrap();
            (b - a).cross(c - a).y
        };
        let down = geometry.triangles().filter(|t| up(*t) < 0.0).count();
        assert!(
            !is_horizon || down == 0,
            "{}: {down} look down",
            surface.name
        );
    }
    Some(surfaces)
}

/// Drogon lies at the position that its files declare.
fn assert_in_drogon(surface: &Surface) {
    let low = DVec3::new(455_000.0, -2100.0, -5_940_000.0);
    let high = DVec3::new(468_000.0, -1400.0, -5_926_000.0);
    assert!(surface.origin.cmpge(low).all() && surface.origin.cmple(high).all());
}

#[test]
fn drogons_grid_has_66_horizons_of_93_by_147_pillars() {
    let Some(surfaces) = surfaces("drogon/gg.roff") else {
        return;
    };
    assert_eq!(surfaces.len(), 66);
    for surface in &surfaces {
        assert_in_drogon(surface);
        for plan in &surface.plan {
            let [i, j] = [f64::from(plan[0]) * 92.0, f64::from(plan[1]) * 146.0];
            assert!((i - i.round()).abs() < 1e-3 && (j - j.round()).abs() < 1e-3);
        }
    }
    // The top layer is completely active; its faults split about 450 pillars, by at most 100 m.
    let top = &surfaces[0];
    let mut heights: Vec<_> = std::iter::zip(&top.plan, &top.geometry.positions)
        .map(|(plan, position)| (plan.map(f32::to_bits), position[1]))
        .collect();
    heights.sort_by(|a, b| a.partial_cmp(b).unwrap());
    let pillars: Vec<_> = heights.chunk_by(|a, b| a.0 == b.0).collect();
    assert!(pillars.len() <= 93 * 147 && pillars.len() > 93 * 147 * 9 / 10);
    let throws = pillars
        .iter()
        .map(|pillar| pillar[pillar.len() - 1].1 - pillar[0].1);
    let throws: Vec<_> = throws.filter(|throw| *throw > 0.0).collect();
    assert!((400..=500).contains(&throws.len()), "{}", throws.len());
    let most = throws.iter().copied().fold(0.0, f32::max);
    assert!((80.0..=102.0).contains(&most), "{most}");
}

#[test]
fn drogons_porosity_fills_as_much_as_its_cells() {
    let (Some(grid), Some(property)) = (real("drogon/gg.roff"), real("drogon/gg_phit.roff")) else {
        return;
    };
    let grid = read::grid(&grid, &ReadOptions::default()).unwrap();
    let property = read::property(&property).unwrap();
    assert_eq!(grid.size(), [92, 146, 65]);
    assert_eq!(grid.active_cells(), 654_520);
    assert_eq!(
        (property.name.as_str(), property.size),
        ("PHIT", grid.size())
    );
    let size = [150, 160, 120];
    let volume = grid.volume(&property, size, &mut |_, _| ()).unwrap();
    let [low, high] = volume.layout().range;
    assert!(
        low >= 0.0 && high < 0.5,
        "porosities are shares: {low} to {high}"
    );
    let places = (0..size[2]).flat_map(|k| (0..size[1]).map(move |j| (j, k)));
    let places = places.flat_map(|(j, k)| (0..size[0]).map(move |i| [i, j, k]));
    let known = places.filter(|at| volume.sample(*at) != Some(0)).count();
    let sample = volume.layout().steps.iter().map(|step| step.length());
    let sampled = known as f64 * sample.product::<f64>();
    // Volume of a cell: its mean height times its area at mid-height.
    let [nx, ny, nz] = grid.size();
    let cells = (0..nx).flat_map(|i| (0..ny).flat_map(move |j| (0..nz).map(move |k| [i, j, k])));
    let valued = |&[i, j, k]: &[u32; 3]| {
        let index = ((i * ny + j) * nz + k) as usize;
        grid.is_active([i, j, k]) && !property.values[index].is_nan()
    };
    let filled = cells.filter(valued).map(|cell| {
        let [b0, b1, b2, b3, t0, t1, t2, t3] = grid.corners(cell).unwrap();
        let height = (t0.y + t1.y + t2.y + t3.y - b0.y - b1.y - b2.y - b3.y) / 4.0;
        let [sw, se, nw, ne] = [b0 + t0, b1 + t1, b2 + t2, b3 + t3].map(|corner| corner * 0.5);
        height * ((ne - sw).cross(nw - se).y / 2.0).abs()
    });
    let filled = filled.sum::<f64>();
    // Along its faults about 2.5 % of Drogon's cells overlap.
    let share = sampled / filled;
    assert!((0.96..=1.0).contains(&share), "{share}");
}

#[test]
fn drogons_facies_are_codes() {
    let Some(path) = real("drogon/gg_facies.roff") else {
        return;
    };
    let property = read::property(&path).unwrap();
    let codes = [0.0, 1.0, 2.0, 5.0, 6.0, 10.0, 11.0, 12.0];
    let known = property.values.iter().filter(|value| !value.is_nan());
    assert!(known.clone().all(|value| codes.contains(value)));
    assert!(known.count() > 500_000);
}

#[test]
fn drogons_faults_are_six_of_479_triangles() {
    let Some(faults) = surfaces("drogon/ex_faultroom_1.3.1.json") else {
        return;
    };
    let names: Vec<_> = faults.iter().map(|fault| fault.name.as_str()).collect();
    assert_eq!(names, ["F1", "F2", "F3", "F4", "F5", "F6"]);
    let triangles = faults.iter().map(|fault| fault.geometry.triangle_count());
    assert_eq!(triangles.sum::<usize>(), 479);
    faults.iter().for_each(assert_in_drogon);
}

#[test]
fn drogons_fifth_fault_is_a_tsurf() {
    let Some(faults) = surfaces("drogon/F5.ts") else {
        return;
    };
    assert_eq!((faults.len(), faults[0].name.as_str()), (1, "F5"));
    assert_eq!(faults[0].geometry.positions.len(), 44);
    assert_eq!(faults[0].kind, SurfaceKind::Fault);
    assert_in_drogon(&faults[0]);
}

#[test]
fn drogons_map_has_572_by_645_nodes() {
    let Some(maps) = surfaces("drogon/topvolantis--ds_extract_geogrid.gri") else {
        return;
    };
    assert_eq!(maps.len(), 1);
    assert_in_drogon(&maps[0]);
    for plan in &maps[0].plan {
        let [i, j] = [f64::from(plan[0]) * 571.0, f64::from(plan[1]) * 644.0];
        assert!((i - i.round()).abs() < 1e-3 && (j - j.round()).abs() < 1e-3);
    }
    // 20 m apart along both axes.
    assert_eq!(maps[0].geometry.positions.len(), 188_024);
}

#[test]
fn claudius_has_four_horizons_of_some_5200_picks() {
    let Some(horizons) = surfaces("claudius.csv") else {
        return;
    };
    let names: Vec<_> = horizons
        .iter()
        .map(|horizon| horizon.name.as_str())
        .collect();
    assert_eq!(
        names,
        ["strati 250.0", "strati 330.0", "strati 0.0", "strati 60.0"]
    );
    // 5268, 5219, 5259 (19 of them duplicates) and 5277, without those far from all others.
    let points = horizons
        .iter()
        .map(|horizon| horizon.geometry.positions.len());
    assert_eq!(points.collect::<Vec<_>>(), [5268, 5209, 5240, 5277]);
    for horizon in &horizons {
        assert!((-10_700.0..-8600.0).contains(&horizon.origin.y));
        let bounds = horizon.geometry.bounds().unwrap();
        let size = bounds.max - bounds.min;
        assert!((3500.0..3600.0).contains(&size.x) && (5150.0..5300.0).contains(&size.z));
    }
}

#[test]
fn a_lidar_field_is_a_geotiff() {
    let Some(fields) = surfaces("dem.tif") else {
        return;
    };
    assert_eq!(fields[0].geometry.positions.len(), 400 * 400);
    assert_eq!(fields[0].geometry.triangle_count(), 399 * 399 * 2);
    let bounds = fields[0].geometry.bounds().unwrap();
    assert!(
        (bounds.max.x - bounds.min.x - 399.0).abs() < 1e-3,
        "a metre apart"
    );
    let low = fields[0].origin.y + bounds.min.y;
    assert!((low - 379.66).abs() < 0.01, "{low}");
}
