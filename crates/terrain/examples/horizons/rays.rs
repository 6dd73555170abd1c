//! Processor time for each vertex and direction, by method, with one thread and with two.

use std::error::Error;

use antumbra_terrain::{Field, Horizons, Method, Scope, Sectors};

use crate::clock::Clock;
use crate::tables::REACHES;

pub fn print(field: &Field) -> Result<(), Box<dyn Error>> {
    println!(
        "| method | µs of processor time a vertex and direction (with two threads for a large field) | one thread, s | two threads, s | times as fast |\n|---|---|---|---|---|"
    );
    // A large field is measured with two threads only, and without edges.
    let large = field.points().len() > 200_000;
    let sectors = Sectors::new(16, 4)?;
    let queries = field.points().len() as f64 * f64::from(sectors.count() * sectors.parts());
    for (method, scope, reaches) in [
        (Method::Thesis, Scope::Vertices, 1),
        (Method::Rays, Scope::Vertices, 1),
        (Method::Rays, Scope::Vertices, REACHES),
        (Method::Sound, Scope::Vertices, 1),
        (Method::Sound, Scope::Vertices, REACHES),
        (Method::Sound, Scope::Surface, 1),
        (Method::Sound, Scope::Surface, REACHES),
    ] {
        let sectors = sectors.with_reaches(reaches)?;
        if large && (scope == Scope::Surface || reaches > 1) {
            continue;
        }
        let mut walls = [0.0; 2];
        let mut each = 0.0;
        for (threads, wall) in (1..).zip(&mut walls).skip(usize::from(large)) {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()?;
            let clock = Clock::start();
            pool.install(|| Horizons::find(field, sectors, method, scope, &|| ()));
            *wall = clock.wall();
            if threads == 1 || large {
                each = clock.processor() / queries * 1e6;
            }
        }
        let [one, two] = walls;
        println!(
            "| {method}, {scope:?}, reaches {reaches} | {each:.2} | {one:.2} | {two:.2} | {:.2} |",
            one / two
        );
    }
    println!();
    Ok(())
}
