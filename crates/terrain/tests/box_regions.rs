//! Boxes: those that an observer does not see are compared with lines of sight to points all over them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use antumbra_terrain::{
    AzimuthRange, BoxRegions, Field, GroupOptions, LineOfSight, Method, Observer, Sectors, Terrain,
    TerrainOptions,
};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

fn prepared(field: Field, [sectors, parts]: [u32; 2], reaches: u32) -> Terrain {
    let sectors = Sectors::new(sectors, parts).unwrap();
    let options = TerrainOptions {
        sectors: sectors.with_reaches(reaches).unwrap(),
        method: Method::Sound,
        groups: Some(GroupOptions {
            seeds: 4,
            max_groups: 8,
            ..GroupOptions::for_triangles(0)
        }),
    };
    Terrain::prepare(field, &options, &|| ()).unwrap()
}

/// A random number between two numbers.
fn between(rng: &mut Pcg32, low: f64, high: f64) -> f64 {
    low + (high - low) * support::number(rng)
}

/// A random viewpoint above the surface.
fn viewpoint(terrain: &Terrain, rng: &mut Pcg32) -> DVec3 {
    let [low, high] = terrain.field().plan_bounds();
    loop {
        let plan = DVec2::new(between(rng, low.x, high.x), between(rng, low.y, high.y));
        if let Some(height) = terrain.height(plan) {
            let up = [0.5, 3.0, 20.0, 80.0][(rng.next_u32() % 4) as usize];
            return plan.extend(height + up);
        }
    }
}

/// Whether any of many points of a box is visible: its corners, points of its top and points within it. A point below the surface is not,
/// whether or not an edge hides it.
fn is_seen(
    terrain: &Terrain,
    line_of_sight: &LineOfSight<'_>,
    eye: DVec3,
    [low, high]: [DVec3; 2],
    rng: &mut Pcg32,
) -> bool {
    let corner = |at: u32| [0, 1, 2].map(|axis| f64::from(at >> axis & 1));
    let mut shares: Vec<DVec3> = (0..8).map(|at| DVec3::from(corner(at))).collect();
    for at in 0..24 {
        let [x, y, z] = [(); 3].map(|()| support::number(rng));
        shares.push(DVec3::new(x, y, if at % 2 == 0 { 1.0 } else { z }));
    }
    let is_visible = |point: DVec3| {
        let ground = terrain.height(point.truncate());
        ground.is_none_or(|ground| point.z >= ground) && !line_of_sight.is_blocked(eye, point)
    };
    let mut points = shares.into_iter().map(|share| low + (high - low) * share);
    let inside = eye.cmpge(low).all() && eye.cmple(high).all();
    inside || points.any(is_visible)
}

#[derive(Debug, Default)]
struct Tally {
    hidden: usize,
    found: usize,
    /// The viewpoint and the box of each false cull.
    wrong: Vec<(DVec3, [DVec3; 2])>,
}

/// Tests boxes from random viewpoints.
fn tally(terrain: &Terrain, boxes: &[[DVec3; 2]], eyes: usize, seed: u64) -> Tally {
    let line_of_sight = LineOfSight::new(terrain.field());
    let all: Vec<BoxRegions> = terrain.box_regions(boxes, &|| ());
    assert_eq!(all.len(), boxes.len());
    let mut rng = Pcg32::seed_from_u64(seed);
    let mut tally = Tally::default();
    for _ in 0..eyes {
        let at = viewpoint(terrain, &mut rng);
        let observer = Observer::new(terrain.groups(), at, AzimuthRange::ALL);
        for (regions, of) in all.iter().zip(boxes) {
            let seen = is_seen(terrain, &line_of_sight, at, *of, &mut rng);
            let culled = observer.is_box_hidden(regions);
            tally.hidden += usize::from(!seen);
            tally.found += usize::from(!seen && culled);
            if seen && culled {
                tally.wrong.push((at, *of));
            }
        }
    }
    tally
}

/// Random boxes of up to `wide` metres: on the ground, half in it, under it, above it, and beyond the field's boundary.
fn boxes(terrain: &Terrain, count: usize, wide: f64, seed: u64) -> Vec<[DVec3; 2]> {
    let mut rng = Pcg32::seed_from_u64(seed);
    let [low, high] = terrain.field().plan_bounds();
    let beyond = (high - low) * 0.1;
    (0..count)
        .map(|_| {
            let plan = DVec2::new(
                between(&mut rng, low.x - beyond.x, high.x + beyond.x),
                between(&mut rng, low.y - beyond.y, high.y + beyond.y),
            );
            let size = DVec3::new(
                between(&mut rng, 0.0, wide),
                between(&mut rng, 0.0, wide),
                between(&mut rng, 0.0, 25.0),
            );
            let ground = terrain.height(plan).unwrap_or_default();
            let lift = [0.0, -size.z / 2.0, -2.0 * size.z, 30.0][(rng.next_u32() % 4) as usize];
            let corner = plan.extend(ground + lift);
            [corner, corner + size]
        })
        .collect()
}

#[test]
fn no_place_of_a_hidden_box_is_seen_and_a_share_of_the_hidden_is_found() {
    let [far, near] = [1, 3].map(|reaches| {
        let terrain = prepared(support::ridged(5, 30.0, 150.0, 42), [16, 8], reaches);
        [(8.0, 0.65), (40.0, 0.5), (300.0, 0.1)].map(|(wide, least)| {
            let boxes = boxes(&terrain, 120, wide, 3);
            let tally = tally(&terrain, &boxes, 60, 4);
            assert!(tally.wrong.is_empty(), "{wide}: {:?}", tally.wrong);
            let share = tally.found as f64 / tally.hidden as f64;
            assert!(share > least, "{wide}: {share} of {}", tally.hidden);
            share
        })
    });
    assert!(near > far, "{near:?} {far:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn nothing_that_is_seen_is_hidden_on_any_terrain(
        seed in 0_u64..1000,
        sectors in prop::sample::select(vec![[4, 1], [8, 3], [32, 2]]),
        reaches in 1_u32..4,
        wide in prop::sample::select(vec![0.0, 5.0, 60.0, 2000.0]),
    ) {
        let terrain = prepared(support::shaken(4, 30.0, 200.0, seed), sectors, reaches);
        let tally = tally(&terrain, &boxes(&terrain, 40, wide, seed), 20, seed + 1);
        prop_assert!(tally.wrong.is_empty(), "{:?}", tally.wrong);
    }
}

/// A ridge from south to north, 60 metres high, along the middle of a plain.
fn ridge() -> Terrain {
    let mut heights = vec![vec![0.0; 33]; 33];
    for line in &mut heights {
        for (column, height) in line.iter_mut().enumerate() {
            *height = (60.0 - 30.0 * (column as f64 - 16.0).abs()).max(0.0);
        }
    }
    prepared(support::grid(&heights, 30.0, 1.0), [32, 4], 2)
}

/// A box of `size` metres, `east` metres from the middle of the ridge's field and `up` metres above the plain.
fn at(terrain: &Terrain, east: f64, up: f64, size: DVec3) -> [DVec3; 2] {
    let [low, high] = terrain.field().plan_bounds();
    let middle = (low + high) / 2.0 + DVec2::new(east, 0.0);
    let base = -terrain.field().origin().z;
    let corner = middle.extend(base + up) - (size / 2.0).with_z(0.0);
    [corner, corner + size]
}

fn is_hidden(terrain: &Terrain, eye: DVec3, of: [DVec3; 2]) -> bool {
    let regions = terrain.box_regions(&[of], &|| ()).remove(0);
    Observer::new(terrain.groups(), eye, AzimuthRange::ALL).is_box_hidden(&regions)
}

#[test]
fn a_ridge_hides_what_is_lower_behind_it_and_nothing_on_it_or_before_it() {
    let terrain = ridge();
    let west = at(&terrain, -400.0, 5.0, DVec3::ZERO)[0];
    let house = DVec3::new(12.0, 12.0, 10.0);
    for (east, up, size, hidden) in [
        (200.0, 0.0, house, true),
        // Half in the ground, under it, and beyond the field's boundary.
        (200.0, -5.0, house, true),
        (200.0, -50.0, house, true),
        (700.0, 0.0, house, true),
        // Under the ground, and so wide that the highest terrain seen from its far side lies within it.
        (200.0, -50.0, DVec3::new(100.0, 100.0, 10.0), true),
        // So high that it is seen over the ridge, and above the ridge.
        (200.0, 0.0, house.with_z(120.0), false),
        (200.0, 90.0, house, false),
        // In front of the ridge, and on its crest.
        (-200.0, 0.0, house, false),
        (0.0, 55.0, house, false),
        // With the ridge inside of it, or under a part of it: terrain beside it or in it hides nothing.
        (0.0, -500.0, DVec3::new(120.0, 120.0, 520.0), false),
        (25.0, 0.0, DVec3::new(250.0, 12.0, 10.0), false),
        // Larger than the whole field.
        (0.0, -1e4, DVec3::new(1e4, 1e4, 1e4), false),
    ] {
        let of = at(&terrain, east, up, size);
        assert_eq!(is_hidden(&terrain, west, of), hidden, "{east} {up} {size}");
    }
    // From higher up, over the ridge, the far side of a long box is visible where its near side is not.
    let above = west + DVec3::Z * 125.0;
    assert!(is_hidden(&terrain, above, at(&terrain, 80.0, 0.0, house)));
    let long = DVec3::new(250.0, 12.0, 10.0);
    assert!(!is_hidden(&terrain, above, at(&terrain, 200.0, 0.0, long)));
    // Seen along the ridge, no terrain is in front of it.
    let south = at(&terrain, 200.0, 5.0, DVec3::ZERO)[0] - DVec3::Y * 400.0;
    assert!(!is_hidden(&terrain, south, at(&terrain, 200.0, 0.0, house)));
}

#[test]
fn what_is_no_box_is_hidden_from_nobody() {
    let terrain = ridge();
    let west = at(&terrain, -400.0, 5.0, DVec3::ZERO)[0];
    let [low, high] = at(&terrain, 200.0, 0.0, DVec3::ONE);
    assert!(is_hidden(&terrain, west, [low, high]));
    for of in [
        [DVec3::NAN, high],
        [low, high.with_z(f64::INFINITY)],
        [DVec3::INFINITY, DVec3::NEG_INFINITY],
        [low + DVec3::X * 1e7, high + DVec3::X * 1e7],
        [low * 1e300, high * 1e300],
    ] {
        assert!(!is_hidden(&terrain, west, of), "{of:?}");
    }
    assert!(
        terrain
            .box_regions(&[], &|| panic!("there is nothing to find"))
            .is_empty()
    );
}

#[test]
fn boxes_are_judged_each_by_itself() {
    let terrain = prepared(support::ridged(4, 30.0, 150.0, 8), [16, 4], 1);
    let boxes = boxes(&terrain, 30, 30.0, 5);
    let together = terrain.box_regions(&boxes, &|| ());
    for (at, of) in boxes.iter().enumerate() {
        assert_eq!(terrain.box_regions(&[*of], &|| ())[0], together[at]);
    }
}
