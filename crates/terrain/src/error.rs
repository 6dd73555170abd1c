//! What can go wrong with a height field: what, where, and what to do.

use thiserror::Error;

use crate::field::Fault;

/// Why there is no such terrain.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TerrainError {
    /// A mesh that is not single-valued over the plan, or not a surface.
    #[error("this is no height field: {}", list(faults, *total))]
    NotAHeightField {
        /// The first of its faults.
        faults: Vec<Fault>,
        /// How many there are in all; of triangles one above the other at least so many.
        total: usize,
    },
    /// More than can be numbered.
    #[error("{count} {what} are more than {most}; divide the field into blocks")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// How many there may be.
        most: usize,
    },
    /// A raster that no field can be made of.
    #[error("no field can be made of this raster: {problem}")]
    BadRaster {
        /// What is wrong, and what to do.
        problem: String,
    },
    /// The scene refused something.
    #[error(transparent)]
    Scene(#[from] antumbra_scene::SceneError),
    /// A scene file that cannot be read.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Load(#[from] antumbra_formats::LoadError),
    /// A scene file that cannot be written.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Save(#[from] antumbra_formats::SaveError),
    /// A scene without what is known of its terrain.
    #[error(
        "it has no extension ANTUMBRA_horizons: write it with Terrain::save or `antumbra prepare`"
    )]
    NotPrepared,
    /// What a file says of its terrain cannot be.
    #[error("its extension ANTUMBRA_horizons cannot be used: {problem}; prepare the terrain again")]
    BadFile {
        /// What is wrong, and where.
        problem: String,
    },
    /// A setting out of its range.
    #[error("{what} cannot be {value}: {problem}")]
    Setting {
        /// Its name.
        what: &'static str,
        /// What was asked for.
        value: String,
        /// What is possible.
        problem: &'static str,
    },
}

fn list(faults: &[Fault], total: usize) -> String {
    let mut text = faults
        .iter()
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join("; ");
    if let Some(more) = total.checked_sub(faults.len()).filter(|more| *more > 0) {
        text.push_str(&format!("; and {more} more"));
    }
    text
}
