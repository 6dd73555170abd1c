//! `antumbra prepare`: rasters and meshes made into terrains, horizons, faults and picks into scenes, cell properties into volumes.

mod subsurface;
mod terrain;

use std::path::{Path, PathBuf};

use crate::args::{Made, PrepareArgs, TerrainArgs};
use crate::failure::Failure;
use crate::landscape::is_mesh;
use crate::outputs::Outputs;

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
        return terrain::scene(&args, &mut outputs);
    }
    if args.terrain != TerrainArgs::default() {
        return Err(Failure::Usage(
            "--vertices, --error, --sectors, --parts, --reaches, --method, --seeds and --seed are for terrains: add --as terrain to make one"
                .to_owned(),
        ));
    }
    outputs.probe()?;
    match ending.as_deref() {
        Some("vol") => subsurface::volume(&args),
        _ => subsurface::scene(&args),
    }
}

/// What such inputs become by default. Formats of both kinds become sub-surface.
fn guess(inputs: &[PathBuf]) -> Made {
    let own = |input: &Path| {
        let ending = input.extension().and_then(|ending| ending.to_str());
        let ending = ending.unwrap_or_default().to_lowercase();
        let either = matches!(ending.as_str(), "json" | "jsonl");
        ending == "npz" || (is_mesh(input) && !either) || terrain::is_built_in(input)
    };
    match inputs.iter().any(|input| own(input)) {
        true => Made::Terrain,
        false => Made::Subsurface,
    }
}
