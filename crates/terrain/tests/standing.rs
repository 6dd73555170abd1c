//! Boxes that are said to be hidden, against lines of sight to places all over them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use antumbra_terrain::{
    Arc, Eye, Field, GroupOptions, Method, Sectors, Sights, Stand, Terrain, TerrainOptions,
};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

fn prepared(field: Field, sectors: (u32, u32), reaches: u32) -> Terrain {
    let sectors = Sectors::new(sectors.0, sectors.1).unwrap();
    let options = TerrainOptions {
        sectors: sectors.with_reaches(reaches).unwrap(),
        method: Method::Sound,
        groups: Some(GroupOptions {
            seeds: 4,
            most: 8,
            ..GroupOptions::for_triangles(0)
        }),
    };
    Terrain::prepare(field, &options, &|| ()).unwrap()
}

/// A number between two.
fn between(chance: &mut Pcg32, low: f64, high: f64) -> f64 {
    low + (high - low) * support::number(chance)
}

/// Somebody above the surface.
fn eye(terrain: &Terrain, chance: &mut Pcg32) -> DVec3 {
    let [low, high] = terrain.field().plan_bounds();
    loop {
        let plan = DVec2::new(
            between(chance, low.x, high.x),
            between(chance, low.y, high.y),
        );
        if let Some(height) = terrain.height(plan) {
            let up = [0.5, 3.0, 20.0, 80.0][(chance.next_u32() % 4) as usize];
            return plan.extend(height + up);
        }
    }
}

/// Whether any of many places of a box is in sight: its corners, places of its top and of the whole of it. What lies below the surface is not,
/// be there an edge before it or none.
fn is_seen(
    (terrain, sights): (&Terrain, &Sights<'_>),
    eye: DVec3,
    [low, high]: [DVec3; 2],
    chance: &mut Pcg32,
) -> bool {
    let corner = |at: u32| [0, 1, 2].map(|axis| f64::from(at >> axis & 1));
    let mut shares: Vec<DVec3> = (0..8).map(|at| DVec3::from(corner(at))).collect();
    for at in 0..24 {
        let [x, y, z] = [(); 3].map(|()| support::number(chance));
        shares.push(DVec3::new(x, y, if at % 2 == 0 { 1.0 } else { z }));
    }
    let in_sight = |place: DVec3| {
        let ground = terrain.height(place.truncate());
        ground.is_none_or(|ground| place.z >= ground) && !sights.is_blocked(eye, place)
    };
    let places = shares.into_iter().map(|share| low + (high - low) * share);
    let inside = eye.cmpge(low).all() && eye.cmple(high).all();
    inside || places.into_iter().any(in_sight)
}

#[derive(Debug, Default)]
struct Tally {
    hidden: usize,
    found: usize,
    wrong: Vec<(DVec3, [DVec3; 2])>,
}

/// Judges boxes from chance eyes.
fn tally(terrain: &Terrain, boxes: &[[DVec3; 2]], eyes: usize, seed: u64) -> Tally {
    let sights = Sights::new(terrain.field());
    let stands: Vec<Stand> = terrain.stand(boxes, &|| ());
    assert_eq!(stands.len(), boxes.len());
    let mut chance = Pcg32::seed_from_u64(seed);
    let mut tally = Tally::default();
    for _ in 0..eyes {
        let at = eye(terrain, &mut chance);
        let eye = Eye::new(terrain.groups(), at, Arc::ALL);
        for (stand, of) in stands.iter().zip(boxes) {
            let seen = is_seen((terrain, &sights), at, *of, &mut chance);
            let culled = eye.misses(stand);
            tally.hidden += usize::from(!seen);
            tally.found += usize::from(!seen && culled);
            if seen && culled {
                tally.wrong.push((at, *of));
            }
        }
    }
    tally
}

/// Boxes of up to `wide` metres: on the ground, half in it, under it, above it, and beyond the field's border.
fn boxes(terrain: &Terrain, count: usize, wide: f64, seed: u64) -> Vec<[DVec3; 2]> {
    let mut chance = Pcg32::seed_from_u64(seed);
    let [low, high] = terrain.field().plan_bounds();
    let beyond = (high - low) * 0.1;
    (0..count)
        .map(|_| {
            let plan = DVec2::new(
                between(&mut chance, low.x - beyond.x, high.x + beyond.x),
                between(&mut chance, low.y - beyond.y, high.y + beyond.y),
            );
            let size = DVec3::new(
                between(&mut chance, 0.0, wide),
                between(&mut chance, 0.0, wide),
                between(&mut chance, 0.0, 25.0),
            );
            let ground = terrain.height(plan).unwrap_or_default();
            let lift = [0.0, -size.z / 2.0, -2.0 * size.z, 30.0][(chance.next_u32() % 4) as usize];
            let corner = plan.extend(ground + lift);
            [corner, corner + size]
        })
        .collect()
}

#[test]
fn no_place_of_a_hidden_box_is_seen_and_a_share_of_the_hidden_is_found() {
    let [far, near] = [1, 3].map(|reaches| {
        let terrain = prepared(support::ridged(5, 30.0, 150.0, 42), (16, 8), reaches);
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
        sectors in prop::sample::select(vec![(4, 1), (8, 3), (32, 2)]),
        reaches in 1_u32..4,
        wide in prop::sample::select(vec![0.0, 5.0, 60.0, 2000.0]),
    ) {
        let terrain = prepared(support::shaken(4, 30.0, 200.0, seed), sectors, reaches);
        let tally = tally(&terrain, &boxes(&terrain, 40, wide, seed), 20, seed + 1);
        prop_assert!(tally.wrong.is_empty(), "{:?}", tally.wrong);
    }
}

/// A ridge 60 metres high along the middle of a plain, from south to north.
fn ridge() -> Terrain {
    let mut heights = vec![vec![0.0; 33]; 33];
    for line in &mut heights {
        for (column, height) in line.iter_mut().enumerate() {
            *height = (60.0 - 30.0 * (column as f64 - 16.0).abs()).max(0.0);
        }
    }
    prepared(support::grid(&heights, 30.0, 1.0), (32, 4), 2)
}

/// A box of `size` metres around a place of the ridge's field, whose middle is its origin in the plan.
fn at(terrain: &Terrain, east: f64, up: f64, size: DVec3) -> [DVec3; 2] {
    let [low, high] = terrain.field().plan_bounds();
    let middle = (low + high) / 2.0 + DVec2::new(east, 0.0);
    let base = -terrain.field().origin().z;
    let corner = middle.extend(base + up) - (size / 2.0).with_z(0.0);
    [corner, corner + size]
}

fn is_hidden(terrain: &Terrain, eye: DVec3, of: [DVec3; 2]) -> bool {
    let stand = terrain.stand(&[of], &|| ()).remove(0);
    Eye::new(terrain.groups(), eye, Arc::ALL).misses(&stand)
}

#[test]
fn a_ridge_hides_what_is_lower_behind_it_and_nothing_on_it_or_before_it() {
    let terrain = ridge();
    let west = at(&terrain, -400.0, 5.0, DVec3::ZERO)[0];
    let house = DVec3::new(12.0, 12.0, 10.0);
    for (east, up, size, hidden) in [
        (200.0, 0.0, house, true),
        // Half in the ground, under it, and beyond the field's border.
        (200.0, -5.0, house, true),
        (200.0, -50.0, house, true),
        (700.0, 0.0, house, true),
        // So wide under the ground that what is highest above its far side lies within it.
        (200.0, -50.0, DVec3::new(100.0, 100.0, 10.0), true),
        // As high as the ridge is from here, and higher.
        (200.0, 0.0, house.with_z(120.0), false),
        (200.0, 90.0, house, false),
        // Before the ridge, and on its peak.
        (-200.0, 0.0, house, false),
        (0.0, 55.0, house, false),
        // With the ridge inside of it, or under a part of it: what is beside it or in it hides nothing.
        (0.0, -500.0, DVec3::new(120.0, 120.0, 520.0), false),
        (25.0, 0.0, DVec3::new(250.0, 12.0, 10.0), false),
        // Larger than all.
        (0.0, -1e4, DVec3::new(1e4, 1e4, 1e4), false),
    ] {
        let of = at(&terrain, east, up, size);
        assert_eq!(is_hidden(&terrain, west, of), hidden, "{east} {up} {size}");
    }
    // From higher up, over the ridge, the far side of a long one is seen where its near side is not.
    let above = west + DVec3::Z * 125.0;
    assert!(is_hidden(&terrain, above, at(&terrain, 80.0, 0.0, house)));
    let long = DVec3::new(250.0, 12.0, 10.0);
    assert!(!is_hidden(&terrain, above, at(&terrain, 200.0, 0.0, long)));
    // Seen along the ridge nothing stands before it.
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
            .stand(&[], &|| panic!("there is nothing to find"))
            .is_empty()
    );
}

#[test]
fn boxes_are_judged_each_by_itself() {
    let terrain = prepared(support::ridged(4, 30.0, 150.0, 8), (16, 4), 1);
    let boxes = boxes(&terrain, 30, 30.0, 5);
    let together = terrain.stand(&boxes, &|| ());
    for (at, of) in boxes.iter().enumerate() {
        assert_eq!(terrain.stand(&[*of], &|| ())[0], together[at]);
    }
}
