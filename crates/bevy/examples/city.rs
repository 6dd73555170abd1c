//! Antumbra's city in Bevy, and a walk along a street.
//!
//!     scripts/bevy.sh run --example city -- --measure --frames 20

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

use antumbra_demo_scenes::{CityOptions, city};
use bevy::prelude::*;
use view::{View, Way};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = city(CityOptions {
        size: arguments::Arguments::of_process().scene_size.unwrap_or(2),
        ..CityOptions::default()
    })?;
    let view = View {
        way: Way::Walk {
            from: Vec3::new(1.5, 1.7, 80.0),
            to: Vec3::new(1.5, 1.7, -80.0),
            step: 0.15,
            sideways: 0.6,
        },
        degrees: 60.0,
    };
    run::run(view, &|app| spawn::spawn(app, &scene));
    Ok(())
}
