//! `antumbra prepare`: rasters and meshes made into terrains, horizons, faults and picks into scenes, cell properties into volumes.

mod subsurface;
mod terrain;

use std::path::{Path, PathBuf};

use crate::args::{Made, PrepareArgs, TerrainArgs};
use crate::failure::Failure;
use crate::landscape::{is_mesh, is_raster};
use crate::notes;
use crate::outputs::Outputs;
use crate::scene_file;

/// Reads, prepares and writes; prints a summary.
///
/// # Errors
/// What stopped it; nothing half-written stays behind.
pub fn run(args: PrepareArgs) -> Result<(), Failure> {
    let mut outputs = Outputs::default();
    (args.input.iter()).for_each(|input| outputs.reads("the input", input));
    (args.subsurface.grid.iter()).for_each(|grid| outputs.reads("--grid", grid));
    outputs.writes("--output", &args.output);
    outputs.check()?;
    let ending = args.output.extension().and_then(|ending| ending.to_str());
    let ending = ending.map(str::to_lowercase);
    let made = match ending.as_deref() {
        Some("glb") => args.made.unwrap_or_else(|| guess(&args.input)),
        // Volumes are sub-surface.
        Some("vol") => Made::Subsurface,
        _ => {
            return Err(Failure::Usage(format!(
                "--output '{}': scenes are written as .glb, volumes as .vol",
                args.output.display()
            )));
        }
    };
    if made == Made::Terrain {
        outputs.probe()?;
        terrain::scene(&args, &mut outputs)?;
        say_what(&args, made);
        return Ok(());
    }
    if args.terrain != TerrainArgs::default() {
        return Err(Failure::Usage(
            "--vertices, --error, --sectors, --parts, --reaches, --method, --seeds and --seed are for terrains: add --as terrain to make one"
                .to_owned(),
        ));
    }
    scene_file::none(&args.load)?;
    outputs.probe()?;
    if ending.as_deref() == Some("vol") {
        return subsurface::volume(&args);
    }
    subsurface::scene(&args)?;
    say_what(&args, made);
    Ok(())
}

/// Says what rasters were made, where that was not asked for: they could be either.
fn say_what(args: &PrepareArgs, made: Made) {
    let raster = args.input.iter().find(|input| is_raster(input));
    let note = match made {
        Made::Terrain => "one raster alone is made a terrain (--as subsurface makes a horizon)",
        Made::Subsurface => "with other inputs a raster is made a horizon (--as overrides)",
    };
    if let (Some(raster), None) = (raster, args.made) {
        notes::say(raster, &[note.to_owned()], args.quiet);
    }
}

/// What such inputs become by default. One raster alone becomes a terrain, as the commands that draw take it; with others it is a horizon.
fn guess(inputs: &[PathBuf]) -> Made {
    match inputs {
        [raster] if is_raster(raster) => return Made::Terrain,
        _ if inputs.iter().any(|input| is_raster(input)) => return Made::Subsurface,
        _ => {}
    }
    let own = |input: &Path| {
        let ending = input.extension().and_then(|ending| ending.to_str());
        let ending = ending.unwrap_or_default().to_lowercase();
        let either = matches!(ending.as_str(), "json" | "jsonl");
        (is_mesh(input) && !either) || terrain::is_built_in(input)
    };
    match inputs.iter().any(|input| own(input)) {
        true => Made::Terrain,
        false => Made::Subsurface,
    }
}
