//! `antumbra prepare`: rasters and meshes made into terrains, horizons, faults and picks into scenes, cell properties into volumes.

mod subsurface;
mod terrain;

use std::path::Path;

use crate::args::{Made, PrepareArgs, TerrainArgs};
use crate::failure::Failure;
use crate::landscape::is_mesh;

/// Reads, prepares and writes; says what came of it.
///
/// # Errors
/// What stopped it; nothing half-written stays behind.
pub fn run(args: PrepareArgs) -> Result<(), Failure> {
    let ending = args.output.extension().and_then(|ending| ending.to_str());
    let ending = ending.map(str::to_lowercase);
    let made = match ending.as_deref() {
        Some("glb") => args.made.unwrap_or_else(|| guess(&args.input)),
        // A volume is below the ground.
        Some("vol") => Made::Subsurface,
        _ => {
            return Err(Failure::Usage(format!(
                "'{}' says neither scene (.glb) nor volume (.vol) by its ending",
                args.output.display()
            )));
        }
    };
    if made == Made::Terrain {
        return terrain::scene(&args);
    }
    if args.terrain != TerrainArgs::default() {
        return Err(Failure::Usage(
            "--vertices, --error, --sectors, --parts, --reaches, --method, --seeds and --seed are for terrains: say --as terrain if that is what is to be made"
                .to_owned(),
        ));
    }
    match ending.as_deref() {
        Some("vol") => subsurface::volume(&args),
        _ => subsurface::scene(&args),
    }
}

/// What such inputs are made into where nobody says. Files that hold either stay what they always were.
fn guess(inputs: &[std::path::PathBuf]) -> Made {
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
