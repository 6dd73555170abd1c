//! Preparation: tiles contain exactly the horizon, join without cracks at every level, and proxies cover their tiles.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::{HashMap, HashSet};

use antumbra_scene::{Geometry, Raster};
use antumbra_subsurface::{
    PrepareOptions, PreparedSurface, SubsurfaceError, Surface, SurfaceKind, prepare_surface,
    prepare_surfaces,
};
use glam::{DVec2, Vec3};
use proptest::prelude::*;

/// Hills on `side` x `side` nodes 10 m apart, with a hole where `hole` is true.
fn hills(side: u32, hole: impl Fn(u32, u32) -> bool) -> Surface {
    let height = |column: u32, row: u32| {
        let (x, y) = (f64::from(column) / 9.0, f64::from(row) / 7.0);
        (x.sin() * 40.0 + (y * 1.3).cos() * 30.0 + (x * y / 9.0).sin() * 15.0) as f32
    };
    let nodes = (0..side).flat_map(|row| (0..side).map(move |column| (column, row)));
    let raster = Raster {
        columns: side,
        rows: side,
        origin: DVec2::new(456_000.0, 5_926_000.0),
        step_u: DVec2::new(10.0, 0.0),
        step_v: DVec2::new(0.0, 10.0),
        elevation: nodes
            .map(|(c, r)| if hole(c, r) { f32::NAN } else { height(c, r) })
            .collect(),
    };
    Surface::from_raster(&raster, "hills").unwrap()
}

fn options(tiles: u32, decimation: f64) -> PrepareOptions {
    PrepareOptions {
        tiles,
        decimation,
        ..PrepareOptions::default()
    }
}

type Point = [u32; 3];

fn bits(position: [f32; 3]) -> Point {
    position.map(|v| (v + 0.0).to_bits())
}

/// Edges with a triangle on one side only, over all meshes.
fn borders<'a>(meshes: impl Iterator<Item = &'a Geometry>) -> HashSet<(Point, Point)> {
    let mut edges: HashMap<(Point, Point), i32> = HashMap::new();
    for mesh in meshes {
        for corners in mesh.triangles() {
            let [a, b, c] = corners.map(|i| bits(mesh.positions[i as usize]));
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if from < to {
                    *edges.entry((from, to)).or_default() += 1;
                } else {
                    *edges.entry((to, from)).or_default() -= 1;
                }
            }
        }
    }
    edges
        .into_iter()
        .filter(|(_, count)| *count != 0)
        .map(|(edge, _)| edge)
        .collect()
}

fn high(prepared: &PreparedSurface) -> impl Iterator<Item = &Geometry> {
    prepared.tiles.iter().map(|tile| tile.mesh.full().unwrap())
}

fn proxies(prepared: &PreparedSurface) -> impl Iterator<Item = &Geometry> {
    prepared
        .tiles
        .iter()
        .filter_map(|tile| tile.mesh.proxy.as_ref())
}

fn plan_area<'a>(meshes: impl Iterator<Item = &'a Geometry>) -> f64 {
    let area = |mesh: &Geometry| -> f64 {
        mesh.triangles()
            .map(|corners| {
                let [a, b, c] = corners.map(|i| Vec3::from(mesh.positions[i as usize]).as_dvec3());
                ((b - a).cross(c - a).y * 0.5).abs()
            })
            .sum()
    };
    meshes.map(area).sum()
}

#[test]
fn the_tiles_hold_every_triangle_once() {
    let surface = hills(61, |c, r| (20..25).contains(&c) && (30..41).contains(&r));
    for tiles in [1, 2, 7, 10] {
        let prepared = prepare_surface(&surface, &options(tiles, 50.0)).unwrap();
        assert_eq!(prepared.triangles(), surface.geometry.triangle_count());
        assert_eq!(prepared.tiles.len(), (tiles * tiles) as usize);
        assert_eq!(
            borders(high(&prepared)),
            borders(std::iter::once(&surface.geometry)),
            "{tiles} tiles a side have other borders than the whole"
        );
    }
}

#[test]
fn an_empty_tile_is_left_out() {
    let surface = hills(41, |c, _| c < 21);
    let prepared = prepare_surface(&surface, &options(4, 20.0)).unwrap();
    assert_eq!(prepared.tiles.len(), 8);
    assert!(prepared.tiles.iter().all(|tile| tile.cell[0] >= 2));
}

#[test]
fn stand_ins_are_small_cover_their_horizon_and_lie_right_way_up() {
    let surface = hills(101, |_, _| false);
    for (tiles, decimation) in [(1, 25.0), (5, 25.0), (5, 100.0), (10, 100.0)] {
        let prepared = prepare_surface(&surface, &options(tiles, decimation)).unwrap();
        let full = prepared.triangles() as f64;
        let uncut = prepare_surface(&surface, &options(1, decimation)).unwrap();
        assert!((uncut.proxy_triangles() as f64) <= full / decimation * 1.3);
        // Cutting along a border adds triangles only where it crosses one.
        assert!(prepared.proxy_triangles() < uncut.proxy_triangles() + 12 * 100);
        let covered = plan_area(proxies(&prepared)) / plan_area(high(&prepared));
        assert!((0.97..=1.0001).contains(&covered), "{covered}");
        assert_eq!(prepared.flipped, 0);
    }
}

#[test]
fn every_level_of_a_tile_has_the_same_border() {
    let surface = hills(101, |c, r| c == 50 && r > 20);
    let prepared = prepare_surface(&surface, &options(3, 100.0)).unwrap();
    for tile in &prepared.tiles {
        let levels = &tile.mesh.levels;
        // A version that would consist mostly of its border is not kept.
        assert!(levels.len() > 1, "{}", tile.mesh.name);
        let border = borders(std::iter::once(&levels[0]));
        for pair in levels.windows(2) {
            assert!(pair[1].triangle_count() * 10 < pair[0].triangle_count() * 6);
            assert_eq!(borders(std::iter::once(&pair[1])), border);
        }
    }
}

#[test]
fn a_fault_stays_whole() {
    let surface = Surface {
        kind: SurfaceKind::Fault,
        plan: Vec::new(),
        ..hills(41, |_, _| false)
    };
    let prepared = prepare_surface(&surface, &options(10, 10.0)).unwrap();
    assert_eq!(prepared.tiles.len(), 1);
    assert_eq!(prepared.triangles(), 3200);
    assert!((300..=400).contains(&prepared.proxy_triangles()));
}

#[test]
fn what_is_too_small_to_simplify_stands_for_itself() {
    let one = hills(2, |c, r| c == 1 && r == 1);
    assert_eq!(one.geometry.triangle_count(), 1);
    for kind in [SurfaceKind::Horizon, SurfaceKind::Fault] {
        let surface = Surface {
            kind,
            ..one.clone()
        };
        let prepared = prepare_surface(&surface, &options(1, 100.0)).unwrap();
        assert_eq!((prepared.triangles(), prepared.proxy_triangles()), (1, 1));
    }
}

#[test]
fn thinning_keeps_neighbours_together() {
    let surface = hills(101, |_, _| false);
    let thinned = PrepareOptions {
        thinning: 2.5,
        ..options(5, 100.0)
    };
    let prepared = prepare_surface(&surface, &thinned).unwrap();
    let left = prepared.triangles() as f64 / surface.geometry.triangle_count() as f64;
    assert!((0.38..=0.45).contains(&left), "{left}");
    // The outline of a height field without holes: one closed line, no border inside.
    let outline = borders(high(&prepared));
    let bounds = surface.geometry.bounds().unwrap();
    let on_outline = |point: &Point| {
        let [x, _, z] = point.map(|v| f64::from(f32::from_bits(v)));
        let near = |a: f64, b: f64| (a - b).abs() < 25.0;
        near(x, bounds.min.x)
            || near(x, bounds.max.x)
            || near(z, bounds.min.z)
            || near(z, bounds.max.z)
    };
    assert!(outline.iter().all(|(a, b)| on_outline(a) && on_outline(b)));
}

#[test]
fn options_out_of_range_are_refused_by_name() {
    let surface = hills(5, |_, _| false);
    let cases = [
        (options(0, 100.0), "tiles"),
        (options(65, 100.0), "tiles"),
        (options(10, 0.5), "decimation"),
        (options(10, f64::NAN), "decimation"),
        (
            PrepareOptions {
                thinning: 0.0,
                ..PrepareOptions::default()
            },
            "thinning",
        ),
        (
            PrepareOptions {
                levels: 5,
                ..PrepareOptions::default()
            },
            "levels",
        ),
    ];
    for (options, word) in cases {
        let error = prepare_surface(&surface, &options).unwrap_err();
        assert!(matches!(error, SubsurfaceError::Setting { .. }), "{error}");
        assert!(error.to_string().contains(word), "{error}");
    }
}

#[test]
fn a_surface_that_does_not_fit_together_is_refused_by_name() {
    let good = hills(5, |_, _| false);
    let mut short = good.clone();
    short.plan.pop();
    let mut outside = good.clone();
    outside.plan[3] = [1.5, 0.0];
    let mut torn = good.clone();
    torn.geometry.indices[0] = 9999;
    for (surface, word) in [(short, "plan"), (outside, "vertex 3"), (torn, "9999")] {
        let error =
            prepare_surfaces(&[good.clone(), surface], &options(2, 10.0), &|_| {}).unwrap_err();
        assert!(error.to_string().contains("hills"), "{error}");
        assert!(error.to_string().contains(word), "{error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Low-resolution tiles join as in the undivided low-resolution version: every border edge was one before the
    /// division, or lies on the outline.
    #[test]
    fn stand_ins_meet_without_cracks(side in 12u32..50, tiles in 1u32..13, decimation in 2.0f64..60.0) {
        let surface = hills(side, |c, r| c % 17 == 5 && r % 13 < 4);
        let prepared = prepare_surface(&surface, &options(tiles, decimation)).unwrap();
        // A tile without a triangle of the horizon is dropped, and with it its part of the low-resolution version.
        prop_assume!(prepared.tiles.len() == (tiles * tiles) as usize);
        // Along a cut each part of an edge has a counterpart: only the outline is left, which is as long as that of
        // the undivided version.
        let length = |edges: HashSet<(Point, Point)>| -> f64 {
            edges
                .iter()
                .map(|(a, b)| {
                    let place = |p: &Point| Vec3::from(p.map(f32::from_bits)).as_dvec3();
                    place(a).distance(place(b))
                })
                .sum()
        };
        let uncut = prepare_surface(&surface, &options(1, decimation)).unwrap();
        let (cut, whole) = (length(borders(proxies(&prepared))), length(borders(proxies(&uncut))));
        prop_assert!((cut - whole).abs() < 1e-3 * whole, "{cut} m of border, {whole} m before the cut");
    }
}
