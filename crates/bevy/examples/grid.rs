//! Antumbra's grid in Bevy: 26 x 26 x 26 small spheres, and the orbit of `antumbra compare grid`.
//!
//!     scripts/bevy.sh run --example grid -- --measure --frames 20

#[path = "shared/arguments.rs"]
mod arguments;
#[path = "shared/headless.rs"]
mod headless;
#[path = "shared/measure.rs"]
mod measure;
#[path = "shared/run.rs"]
mod run;
#[path = "shared/spawn.rs"]
mod spawn;
#[path = "shared/stages.rs"]
mod stages;
#[path = "shared/view.rs"]
mod view;

use antumbra_demo_scenes::{GridOptions, grid};
use view::{View, Way};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let defaults = GridOptions::default();
    let scene = grid(GridOptions {
        per_side: arguments::Arguments::of_process()
            .scene_size
            .unwrap_or(defaults.per_side),
        ..defaults
    })?;
    let view = View {
        way: Way::Orbit {
            distance: 40.0,
            height: 10.0,
            radians: 0.02,
        },
        degrees: 45.0,
    };
    run::run(view, &|app| spawn::spawn(app, &scene));
    Ok(())
}
