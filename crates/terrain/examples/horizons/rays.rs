//! Processor time a vertex and direction, method by method, with one thread and with two.

use std::error::Error;

use antumbra_terrain::{Field, Horizons, Method, Scope, Sectors};

use crate::clock::Clock;

pub fn print(field: &Field) -> Result<(), Box<dyn Error>> {
    println!(
        "| method | one thread, µs of processor a vertex and direction | one thread, s | two threads, s | times as fast |\n|---|---|---|---|---|"
    );
    // A large field takes long enough with fewer.
    let large = field.points().len() > 200_000;
    let sectors = Sectors::new(16, if large { 1 } else { 4 })?;
    let questions = field.points().len() as f64 * f64::from(sectors.count() * sectors.parts());
    for (method, scope) in [
        (Method::Thesis, Scope::Vertices),
        (Method::Rays, Scope::Vertices),
        (Method::Sound, Scope::Vertices),
        (Method::Sound, Scope::Surface),
    ] {
        if large && scope == Scope::Surface {
            continue;
        }
        let mut walls = [0.0; 2];
        let mut each = 0.0;
        for (threads, wall) in (1..).zip(&mut walls) {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()?;
            let clock = Clock::start();
            pool.install(|| Horizons::find(field, sectors, method, scope, &|| ()));
            *wall = clock.wall();
            if threads == 1 {
                each = clock.work() / questions * 1e6;
            }
        }
        let [one, two] = walls;
        println!(
            "| {method}, {scope:?} | {each:.2} | {one:.2} | {two:.2} | {:.2} |",
            one / two
        );
    }
    println!();
    Ok(())
}
