//! Observers outside of a field, over its holes and on its boundary, compared with visibility by brute force.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use std::sync::LazyLock;

use antumbra_terrain::{
    AzimuthRange, BoundaryTree, Field, GroupOptions, Sectors, Terrain, TerrainOptions,
};
use glam::{DVec2, DVec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

use support::brute_force::BruteForce;

/// The distance of the near plane, metres.
const NEAR: f64 = 0.2;

/// Viewpoints for each case.
const EYES: usize = 10;

/// The middle of the hole.
const HOLE: DVec2 = DVec2::new(60.0, 0.0);

fn prepared(field: Field) -> Terrain {
    let options = TerrainOptions {
        sectors: Sectors::new(32, 4).unwrap(),
        groups: Some(GroupOptions {
            seeds: 400,
            max_groups: 800,
            min_triangles: 1,
            ..GroupOptions::for_triangles(2048)
        }),
        ..TerrainOptions::default()
    };
    Terrain::prepare(field, &options, &|| ()).unwrap()
}

/// A field without the triangles whose centroids are `removed`.
fn without(field: &Field, removed: impl Fn(DVec2) -> bool) -> Field {
    let kept = |triangle: &u32| {
        let corners = field.corners(*triangle).map(DVec3::truncate);
        !removed(corners.into_iter().sum::<DVec2>() / 3.0)
    };
    let triangles = (0..field.triangles().len() as u32)
        .filter(kept)
        .map(|triangle| field.triangles()[triangle as usize]);
    Field::new(field.points().to_vec(), triangles.collect()).unwrap()
}

/// An island, 960 m by 960 m, with ridges from west to east: whole, with a hole, and with a hole and dents in its boundary. It is one to two
/// hundred metres high, and its boundary is low.
static FIELDS: LazyLock<[Terrain; 3]> = LazyLock::new(|| {
    let whole = support::island(5, 30.0, 150.0, 1);
    let hole = |at: DVec2| at.distance(HOLE) < 80.0;
    let dents = |at: DVec2| {
        let corner = at.x > 300.0 && at.y > 320.0;
        let bay = at.distance(DVec2::new(-480.0, 0.0)) < 160.0;
        hole(at) || corner || bay || at.distance(DVec2::new(100.0, -500.0)) < 120.0
    };
    let holed = without(&whole, hole);
    let dented = without(&whole, dents);
    [whole, holed, dented].map(prepared)
});

/// Counts of valid observers, and of tested triangles that are hidden and that are culled.
#[derive(Debug, Default)]
struct Tally {
    valid: usize,
    hidden: usize,
    culled: usize,
}

impl Tally {
    fn found(&self) -> f64 {
        self.culled as f64 / self.hidden as f64
    }
}

/// Compares, for every viewpoint and some of the triangles, what is culled with what is hidden.
fn tally(terrain: &Terrain, eyes: &[DVec3], seed: u64) -> Tally {
    let field = terrain.field();
    let brute_force = BruteForce::of([field]);
    let mut rng = Pcg32::seed_from_u64(seed);
    let mut tally = Tally::default();
    for &at in eyes {
        let Some(observer) = terrain.observer(at, AzimuthRange::ALL, NEAR) else {
            continue;
        };
        tally.valid += 1;
        let culled = support::culled(terrain, &observer);
        for triangle in 0..field.triangles().len() as u32 {
            if rng.next_u32() % 8 > 0 {
                continue;
            }
            let points = support::points(field, triangle, &mut rng);
            let drawn = culled.binary_search(&triangle).is_err();
            let hidden = points
                .iter()
                .all(|&point| brute_force.hides(at, point, NEAR));
            assert!(drawn || hidden, "triangle {triangle} is seen from {at}");
            tally.hidden += usize::from(hidden);
            tally.culled += usize::from(!drawn);
        }
    }
    tally
}

fn between(rng: &mut Pcg32, low: f64, high: f64) -> f64 {
    low + support::number(rng) * (high - low)
}

/// A random direction.
fn direction(rng: &mut Pcg32) -> DVec2 {
    DVec2::from_angle(between(rng, 0.0, std::f64::consts::TAU))
}

/// Viewpoints outside of the square.
fn outside(rng: &mut Pcg32, [low, high]: [f64; 2]) -> Vec<DVec3> {
    let mut eye = || {
        let direction = direction(rng);
        let edge = 481.0 / direction.abs().max_element();
        let far = edge + support::number(rng).powi(3) * 3000.0;
        (direction * far).extend(between(rng, low, high))
    };
    (0..EYES).map(|_| eye()).collect()
}

/// Viewpoints over the hole.
fn inside(rng: &mut Pcg32, [low, high]: [f64; 2]) -> Vec<DVec3> {
    let mut eye = || {
        let plan = HOLE + direction(rng) * between(rng, 0.0, 55.0);
        plan.extend(between(rng, low, high))
    };
    (0..EYES).map(|_| eye()).collect()
}

#[test]
fn nothing_that_is_seen_from_outside_is_culled() {
    for terrain in FIELDS.iter() {
        let mut rng = Pcg32::seed_from_u64(2);
        let low = tally(terrain, &outside(&mut rng, [-250.0, 50.0]), 3);
        assert!(low.found() > 0.1, "{low:?}");
        let high = tally(terrain, &outside(&mut rng, [50.0, 300.0]), 4);
        assert_eq!(high.valid, EYES);
        assert!(high.found() > 0.2, "{high:?}");
    }
}

#[test]
fn nothing_that_is_seen_from_over_a_hole_is_culled() {
    for terrain in &FIELDS[1..] {
        let mut rng = Pcg32::seed_from_u64(6);
        tally(terrain, &inside(&mut rng, [-250.0, 0.0]), 7);
        let high = tally(terrain, &inside(&mut rng, [0.0, 160.0]), 8);
        assert!(high.found() > 0.3, "{high:?}");
    }
}

#[test]
fn nothing_that_is_seen_across_a_hole_is_culled() {
    for terrain in FIELDS.iter() {
        let field = terrain.field();
        let mut rng = Pcg32::seed_from_u64(10);
        let mut above = || {
            let below = field.point(rng.next_u32() % field.points().len() as u32);
            below + DVec3::Z * between(&mut rng, 0.5, 30.0)
        };
        let eyes: Vec<DVec3> = (0..EYES).map(|_| above()).collect();
        let found = tally(terrain, &eyes, 11);
        assert!(found.found() > 0.2, "{found:?}");
    }
}

#[test]
fn nothing_that_is_seen_along_a_border_is_culled() {
    for terrain in FIELDS.iter() {
        let boundary = BoundaryTree::of(terrain.field());
        let mut rng = Pcg32::seed_from_u64(13);
        let mut eyes = Vec::new();
        for _ in 0..EYES / 2 {
            let [a, b] = boundary.edges()[rng.next_u32() as usize % boundary.edges().len()];
            let up = DVec3::Z * between(&mut rng, 0.3, 60.0);
            let along = (b - a).truncate().extend(0.0);
            // Over the edge's start and middle, and on its line, beyond both ends.
            eyes.extend([a + up, (a + b) / 2.0 + up, a + along * 8.0 + up]);
            eyes.push(a - along * 5.0 - up);
        }
        let found = tally(terrain, &eyes, 14);
        assert!(found.found() > 0.15, "{found:?}");
    }
}

#[test]
fn nothing_that_is_seen_through_a_crack_is_culled() {
    // The eastern half is 40 m higher and half a cell farther north: no two corners are equal.
    let regular = support::grid(&support::ridges(5, 16), 30.0, 150.0);
    let half = |sign: f64| without(&regular, |at| at.x * sign > 0.0);
    let mut points = Vec::new();
    let mut triangles = Vec::new();
    for (field, shift) in [
        (half(1.0), DVec3::ZERO),
        (half(-1.0), DVec3::new(0.0, 15.0, 40.0)),
    ] {
        let first = points.len() as u32;
        let moved = |point: &DVec3| *point + field.origin() + shift;
        points.extend(field.points().iter().map(moved));
        let indices = field.triangles().iter();
        triangles.extend(indices.map(|corners| corners.map(|corner| first + corner)));
    }
    let terrain = prepared(Field::new(points, triangles).unwrap());
    assert_eq!(terrain.field().boundary().rings.len(), 2);
    let mut rng = Pcg32::seed_from_u64(17);
    let mut eye = |east: f64| {
        let north = between(&mut rng, -480.0, 480.0);
        let plan = DVec2::new(between(&mut rng, -east, east), north);
        let highest = terrain.highest_near(plan, 30.0).unwrap();
        plan.extend(highest + between(&mut rng, 0.3, 40.0))
    };
    // Over the whole field, near the crack, and just over the crack.
    let eyes: Vec<DVec3> = (0..3 * EYES)
        .map(|at| eye([480.0, 20.0, 0.0][at % 3]))
        .collect();
    let found = tally(&terrain, &eyes, 18);
    assert!(found.found() > 0.1, "{found:?}");
}

#[test]
fn only_a_convex_ring_is_whole() {
    let square = |low: f64, high: f64| {
        let at = |x, y| DVec3::new(x, y, 0.0);
        let corners = [at(low, low), at(high, low), at(high, high), at(low, high)];
        (0..4).map(move |side| [corners[side], corners[(side + 1) % 4]])
    };
    let ring: Vec<[DVec3; 2]> = square(-2.0, 2.0).collect();
    let reversed: Vec<[DVec3; 2]> = ring.iter().rev().map(|&[a, b]| [b, a]).collect();
    let hole = square(-1.0, 1.0).map(|[a, b]| [b, a]);
    assert!(BoundaryTree::new(ring.clone()).is_convex());
    assert!(!BoundaryTree::new(reversed).is_convex());
    assert!(!BoundaryTree::new(ring.iter().copied().chain(hole).collect()).is_convex());
    assert!(!BoundaryTree::new(ring[1..].to_vec()).is_convex());
    assert!(!BoundaryTree::new(ring.into_iter().chain(square(5.0, 6.0)).collect()).is_convex());
    assert!(!BoundaryTree::new(Vec::new()).is_convex());
    for (terrain, convex) in FIELDS.iter().zip([true, false, false]) {
        assert_eq!(BoundaryTree::of(terrain.field()).is_convex(), convex);
        assert_eq!(terrain.field().boundary().convex, convex);
    }
}
