//! Chance pairs of a vertex and somebody above the surface, judged by every method and by exact lines of sight.

use std::error::Error;

use antumbra_terrain::{Field, Ground, Horizons, Method, Scope, Sectors, Sights};
use glam::{DVec2, DVec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

use crate::tables::{REACHES, SETTINGS};

/// The methods in the order of the columns, with how many reaches.
const METHODS: [(Method, u32); 5] = [
    (Method::Thesis, 1),
    (Method::Rays, 1),
    (Method::Rays, REACHES),
    (Method::Sound, 1),
    (Method::Sound, REACHES),
];

/// How many pairs.
const PAIRS: usize = 100_000;
/// Metres above the surface.
const ABOVE: [f64; 3] = [2.0, 20.0, 100.0];
const SEED: u64 = 1;

/// A place over the field, metres above its surface.
pub fn above(field: &Field, ground: &Ground, chance: &mut Pcg32, metres: f64) -> DVec3 {
    let [low, high] = field.plan_bounds();
    loop {
        let share = DVec2::new(number(chance), number(chance));
        let place = low + (high - low) * share;
        if let Some((_, height)) = ground.below(field, place) {
            return place.extend(height + metres);
        }
    }
}

fn number(chance: &mut Pcg32) -> f64 {
    f64::from(chance.next_u32()) / f64::from(u32::MAX)
}

pub fn print(field: &Field) -> Result<(), Box<dyn Error>> {
    let (ground, sights) = (Ground::new(field), Sights::new(field));
    let mut chance = Pcg32::seed_from_u64(SEED);
    let pairs: Vec<(u32, DVec3)> = (0..PAIRS)
        .map(|number| {
            let vertex = chance.next_u32() % field.points().len() as u32;
            (
                vertex,
                above(field, &ground, &mut chance, ABOVE[number % ABOVE.len()]),
            )
        })
        .collect();
    let hidden: Vec<bool> = pairs
        .par_iter()
        .map(|&(vertex, eye)| sights.is_blocked(eye, field.point(vertex)))
        .collect();
    let blocked = hidden.iter().filter(|hidden| **hidden).count();
    println!("{PAIRS} pairs (seed {SEED}), {blocked} of them hidden.\n");
    println!(
        "| sectors / sub-sectors | method | reaches | visible ones said to be hidden | hidden ones found |\n|---|---|---|---|---|"
    );
    for [count, parts] in SETTINGS.into_iter().chain([[16, 16]]) {
        for (method, reaches) in METHODS {
            let sectors = Sectors::new(count, parts)?.with_reaches(reaches)?;
            let horizons = Horizons::find(field, sectors, method, Scope::Vertices, &|| ());
            let (mut wrong, mut found) = (0, 0);
            for (&(vertex, eye), &hidden) in pairs.iter().zip(&hidden) {
                let said = horizons.hides(field, vertex, eye);
                wrong += usize::from(said && !hidden);
                found += usize::from(said && hidden);
            }
            println!(
                "| {count} / {parts} | {method} | {reaches} | {wrong} ({:.2} %) | {:.1} % |",
                100.0 * wrong as f64 / (PAIRS - blocked) as f64,
                100.0 * found as f64 / blocked as f64,
            );
        }
    }
    println!();
    Ok(())
}
