//! The error type of the crate: what is wrong, where it is, and what to do about it.

use thiserror::Error;

use crate::fault::FieldFault;

/// Why a terrain could not be made, prepared, read or written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TerrainError {
    /// A mesh that is not single-valued over the plan, or is not a surface.
    #[error("the mesh is no height field: {}", list(faults, *total))]
    NotAHeightField {
        /// The first of its faults.
        faults: Vec<FieldFault>,
        /// The number of all faults. Of overlapping triangles only some pairs are counted, so this is a lower bound for them.
        total: usize,
    },
    /// More items than indices can number.
    #[error("{count} {what} are more than {most}; divide the field into tiles")]
    TooMany {
        /// The name of the items.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// How many are allowed.
        most: usize,
    },
    /// A raster that no field can be made of.
    #[error("no field can be made of this raster: {problem}")]
    BadRaster {
        /// What is wrong, and what to do.
        problem: String,
    },
    /// The scene refused an operation.
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
    /// A scene file without the data of a prepared terrain.
    #[cfg(feature = "files")]
    #[error(
        "the file has no extension ANTUMBRA_horizons: write it with Terrain::save or `antumbra prepare`"
    )]
    NotPrepared,
    /// A scene file whose terrain data is damaged or does not fit its scene.
    #[cfg(feature = "files")]
    #[error("the extension ANTUMBRA_horizons cannot be used: {problem}; prepare the terrain again")]
    BadFile {
        /// What is wrong, and where.
        problem: String,
    },
    /// A setting out of its range.
    #[error("{what} cannot be {value}: {problem}")]
    Setting {
        /// The name of the setting.
        what: &'static str,
        /// The value that was given.
        value: String,
        /// The values that are allowed.
        problem: &'static str,
    },
}

/// The faults in one line, and how many are not listed.
fn list(faults: &[FieldFault], total: usize) -> String {
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
