//! Tables 2 and 3 of Edmondson's thesis: how long its seven sector settings take, and the groups that result.

use std::error::Error;

use antumbra_terrain::{Crystals, Field, GroupOptions, Horizons, Method, Scope, Sectors};

use crate::clock::Clock;

/// The sectors and sub-sectors of each setting.
pub const SETTINGS: [[u32; 2]; 7] = [[8, 1], [8, 2], [8, 4], [8, 8], [16, 4], [32, 2], [64, 1]];

/// The number of reaches that the other tables compare with one reach.
pub const REACHES: u32 = 5;

/// The methods in the order of the columns.
const METHODS: [(Method, Scope); 4] = [
    (Method::Thesis, Scope::Surface),
    (Method::Rays, Scope::Surface),
    (Method::Sound, Scope::Vertices),
    (Method::Sound, Scope::Surface),
];

/// The thesis's grouping: seeds by the size of its two terrains, and at most twice as many groups.
pub fn groups(field: &Field) -> GroupOptions {
    let seeds = if field.points().len() < 50_000 {
        100
    } else {
        500
    };
    GroupOptions {
        seeds,
        max_groups: seeds * 2,
        ..GroupOptions::for_triangles(field.triangles().len())
    }
}

pub fn print(field: &Field) -> Result<(), Box<dyn Error>> {
    println!(
        "| sectors / sub-sectors | thesis | rays | sound, vertices | sound, surface |\n|---|---|---|---|---|"
    );
    let mut found: Vec<Vec<Horizons>> = Vec::new();
    for [count, parts] in SETTINGS {
        let sectors = Sectors::new(count, parts)?;
        let mut row = Vec::new();
        print!("| {count} / {parts} |");
        for (method, scope) in METHODS {
            let clock = Clock::start();
            row.push(Horizons::find(field, sectors, method, scope, &|| ()));
            print!(" {:.3} ({:.2}) |", clock.wall(), clock.processor());
        }
        println!();
        found.push(row);
    }
    println!("\nSeconds of wall-clock time (of processor time).\n");
    println!(
        "| sectors / sub-sectors | by | orphan passes | final orphans | final groups | over 130 triangles | seconds |\n|---|---|---|---|---|---|---|"
    );
    let options = groups(field);
    for ([count, parts], row) in SETTINGS.into_iter().zip(&found) {
        for (horizons, (method, scope)) in row.iter().zip(METHODS) {
            // Crystals grow by the horizons of edges.
            if scope == Scope::Vertices {
                continue;
            }
            let clock = Clock::start();
            let crystals = Crystals::grow(field, horizons, &options)?;
            let seconds = clock.wall();
            let large = crystals
                .sizes()
                .into_iter()
                .filter(|size| *size > 130)
                .count();
            println!(
                "| {count} / {parts} | {method} | {} | {} | {} | {large} | {seconds:.3} |",
                crystals.passes,
                crystals.orphans(),
                crystals.count,
            );
        }
    }
    println!();
    Ok(())
}
