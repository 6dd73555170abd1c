//! Antumbra's grid in Bevy: 26 x 26 x 26 small spheres.
//!
//!     cargo +nightly run --ignore-rust-version --example grid -- --measure --frames 20

#[path = "shared/arguments.rs"]
mod arguments;
#[path = "shared/headless.rs"]
mod headless;
#[path = "shared/measure.rs"]
mod measure;
#[path = "shared/spawn.rs"]
mod spawn;
#[path = "shared/view.rs"]
mod view;

use antumbra_demo_scenes::{GridOptions, grid};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments = arguments::Arguments::of_process();
    let scene = grid(GridOptions::default())?;
    measure::measure(&arguments, &view::View::GRID, &|app| {
        spawn::spawn(app, &scene)
    });
    Ok(())
}
