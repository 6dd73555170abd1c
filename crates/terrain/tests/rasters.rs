//! Fields from rasters, and the fractal landscape.
#![allow(clippy::unwrap_used, clippy::panic)]

use antumbra_demo_scenes::terrain::FractalOptions;
use antumbra_scene::{Raster, Scene};
use antumbra_terrain::{Field, Ground, Landscape, RasterDetail};
use glam::DVec2;

fn landscape(order: u32, seed: u64) -> Raster {
    FractalOptions {
        order,
        seed,
        ..FractalOptions::default()
    }
    .raster()
    .unwrap()
}

#[test]
fn a_landscape_follows_its_seed_and_keeps_its_relief() {
    let raster = landscape(5, 1);
    assert_eq!((raster.columns, raster.rows), (33, 33));
    assert!(raster == landscape(5, 1));
    assert!(raster != landscape(5, 2));
    let low = raster.elevation.iter().copied().fold(f32::MAX, f32::min);
    let high = raster.elevation.iter().copied().fold(f32::MIN, f32::max);
    assert!(low == 0.0 && (high - 1500.0).abs() < 0.01);
    // Hills of every width: adjacent posts differ by less than posts far apart, and all differ.
    let apart = |step: usize| {
        let pairs = raster.elevation.iter().zip(&raster.elevation[step..]);
        pairs.map(|(a, b)| (a - b).abs()).sum::<f32>() / (1089 - step) as f32
    };
    assert!(apart(1) > 1.0 && apart(8) > 1.5 * apart(1));
    for bad in [
        FractalOptions {
            order: 0,
            ..Default::default()
        },
        FractalOptions {
            order: 14,
            ..Default::default()
        },
        FractalOptions {
            cell: -1.0,
            ..Default::default()
        },
        FractalOptions {
            relief: f64::NAN,
            ..Default::default()
        },
        FractalOptions {
            roughness: 1.0,
            ..Default::default()
        },
    ] {
        assert!(bad.raster().unwrap_err().to_string().contains("give"));
    }
}

#[test]
fn all_posts_are_vertices_of_the_whole_field() {
    let raster = landscape(4, 3);
    let field = Field::from_raster(&raster, RasterDetail::Full).unwrap();
    assert_eq!(field.points().len(), 17 * 17);
    assert_eq!(field.triangles().len(), 16 * 16 * 2);
    assert!(field.boundary().convex);
}

#[test]
fn no_post_is_farther_away_than_asked_for() {
    let raster = landscape(6, 4);
    for error in [5.0, 40.0] {
        let field = Field::from_raster(&raster, RasterDetail::Error(error)).unwrap();
        let ground = Ground::new(&field);
        for row in 0..raster.rows {
            for column in 0..raster.columns {
                let at = raster.plan_position(column, row) - field.origin().truncate();
                let height = ground.surface_at(&field, at).unwrap().height;
                let post = f64::from(raster.elevation_at(column, row).unwrap()) - field.origin().z;
                assert!((height - post).abs() <= error + 1e-3);
            }
        }
    }
}

#[test]
fn a_number_of_vertices_is_met() {
    let raster = landscape(7, 5);
    for wanted in [200, 1000, 5000] {
        let field = Field::from_raster(&raster, RasterDetail::Vertices(wanted)).unwrap();
        let missed = field.points().len().abs_diff(wanted);
        assert!(missed * 50 <= wanted, "{wanted}: {}", field.points().len());
        assert!(field.boundary().convex);
    }
    assert!(Field::from_raster(&raster, RasterDetail::Vertices(3)).is_err());
    assert!(Field::from_raster(&raster, RasterDetail::Error(f64::NAN)).is_err());
}

#[test]
fn unknown_posts_are_holes_with_their_whole_rim() {
    let mut raster = landscape(5, 6);
    for row in 10..15 {
        for column in 12..20 {
            raster.elevation[row * 33 + column] = f32::NAN;
        }
    }
    raster.elevation[0] = f32::INFINITY;
    for detail in [
        RasterDetail::Full,
        RasterDetail::Error(60.0),
        RasterDetail::Vertices(400),
    ] {
        let field = Field::from_raster(&raster, detail).unwrap();
        assert_eq!(field.boundary().rings.len(), 2, "{detail:?}");
        let ground = Ground::new(&field);
        for row in 0..33 {
            for column in 0..33 {
                let at = raster.plan_position(column, row) - field.origin().truncate();
                let below = ground.surface_at(&field, at);
                assert_eq!(
                    below.is_some(),
                    raster.elevation_at(column, row).is_some(),
                    "{column} {row}"
                );
            }
        }
    }
}

#[test]
fn rasters_without_a_surface_are_refused() {
    let mut raster = landscape(2, 7);
    let refused = |raster: &Raster, word: &str| {
        for detail in [
            RasterDetail::Full,
            RasterDetail::Error(1.0),
            RasterDetail::Vertices(9),
        ] {
            let error = Field::from_raster(raster, detail).unwrap_err().to_string();
            assert!(error.contains(word), "{error}");
        }
    };
    raster.elevation.fill(f32::NAN);
    refused(&raster, "unknown");
    raster.elevation[3] = 1.0;
    refused(&raster, "known");
    raster.step_u = DVec2::ZERO;
    refused(&raster, "no area");
    let mut flat = landscape(3, 8);
    flat.elevation.fill(7.0);
    assert_eq!(
        Field::from_raster(&flat, RasterDetail::Error(0.5))
            .unwrap()
            .triangles()
            .len(),
        2
    );
    assert_eq!(
        Field::from_raster(&flat, RasterDetail::Full)
            .unwrap()
            .triangles()
            .len(),
        128
    );
}

#[test]
fn a_number_of_vertices_is_met_over_more_posts_than_a_search_begins_with() {
    // Hills of several sizes, with a hole.
    let (columns, rows) = (1300, 1200);
    let height = |at: u32| {
        let (x, y) = (f64::from(at % columns), f64::from(at / columns));
        let hills = (x * 0.011).sin() * (y * 0.013).cos() * 300.0;
        let stones = (x * 0.21).sin() * (y * 0.17).sin() * 6.0 + (x * y * 0.003).sin();
        let in_hole = (400.0..420.0).contains(&x) && (300.0..330.0).contains(&y);
        if in_hole {
            f32::NAN
        } else {
            (hills + stones) as f32
        }
    };
    let raster = Raster {
        columns,
        rows,
        origin: DVec2::new(500_000.0, 4_000_000.0),
        step_u: DVec2::new(10.0, 0.0),
        step_v: DVec2::new(0.0, -10.0),
        elevation: (0..columns * rows).map(height).collect(),
    };
    let field = Field::from_raster(&raster, RasterDetail::Vertices(8_000)).unwrap();
    let vertices = field.points().len();
    assert!(vertices.abs_diff(8_000) <= 40, "{vertices}");
    // What is shown without horizons is the same surface.
    let landscape = Landscape::new(field);
    let mut scene = Scene::new();
    landscape.show_lit(&mut scene).unwrap();
    scene.update();
    assert_eq!(
        scene.triangle_count() as usize,
        landscape.field().triangles().len()
    );
    let stations = landscape.flight(30.0, 12);
    assert_eq!(stations.len(), 12);
    assert!(stations.iter().all(|station| station.eye.is_finite()));
}
