//! Random pairs of a vertex and a viewpoint above the surface, tested with every method and with exact lines of sight.

use std::error::Error;

use antumbra_terrain::{Field, Ground, Horizons, LineOfSight, Method, Scope, Sectors};
use glam::{DVec2, DVec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

use crate::tables::{REACHES, SETTINGS};

/// The methods in the order of the columns, with the number of reaches.
const METHODS: [(Method, u32); 5] = [
    (Method::Thesis, 1),
    (Method::Rays, 1),
    (Method::Rays, REACHES),
    (Method::Sound, 1),
    (Method::Sound, REACHES),
];

/// The number of pairs.
const PAIRS: usize = 100_000;
/// The heights of viewpoints above the surface, metres.
const ABOVE: [f64; 3] = [2.0, 20.0, 100.0];
const SEED: u64 = 1;

/// A random position over the field, `metres` above its surface.
pub fn above(field: &Field, ground: &Ground, rng: &mut Pcg32, metres: f64) -> DVec3 {
    let [low, high] = field.plan_bounds();
    loop {
        let share = DVec2::new(number(rng), number(rng));
        let at = low + (high - low) * share;
        if let Some(surface) = ground.surface_at(field, at) {
            return at.extend(surface.height + metres);
        }
    }
}

fn number(rng: &mut Pcg32) -> f64 {
    f64::from(rng.next_u32()) / f64::from(u32::MAX)
}

/// A vertex and a viewpoint.
#[derive(Clone, Copy)]
struct Pair {
    vertex: u32,
    eye: DVec3,
}

pub fn print(field: &Field) -> Result<(), Box<dyn Error>> {
    let (ground, line_of_sight) = (Ground::new(field), LineOfSight::new(field));
    let mut rng = Pcg32::seed_from_u64(SEED);
    let pairs: Vec<Pair> = (0..PAIRS)
        .map(|number| {
            let vertex = rng.next_u32() % field.points().len() as u32;
            let eye = above(field, &ground, &mut rng, ABOVE[number % ABOVE.len()]);
            Pair { vertex, eye }
        })
        .collect();
    let hidden: Vec<bool> = pairs
        .par_iter()
        .map(|&Pair { vertex, eye }| line_of_sight.is_blocked(eye, field.point(vertex)))
        .collect();
    let blocked = hidden.iter().filter(|hidden| **hidden).count();
    println!("{PAIRS} pairs (seed {SEED}), {blocked} of them hidden.\n");
    println!(
        "| sectors / sub-sectors | method | reaches | visible ones culled | hidden ones found |\n|---|---|---|---|---|"
    );
    for [count, parts] in SETTINGS.into_iter().chain([[16, 16]]) {
        for (method, reaches) in METHODS {
            let sectors = Sectors::new(count, parts)?.with_reaches(reaches)?;
            let horizons = Horizons::find(field, sectors, method, Scope::Vertices, &|| ());
            let (mut wrong, mut found) = (0, 0);
            for (&Pair { vertex, eye }, &hidden) in pairs.iter().zip(&hidden) {
                let culled = horizons.hides_vertex(field, vertex, eye);
                wrong += usize::from(culled && !hidden);
                found += usize::from(culled && hidden);
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
