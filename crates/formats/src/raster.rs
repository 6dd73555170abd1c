//! Rasters: elevations on a regular grid, out of Esri ASCII grids, GeoTIFF and NumPy files.
//!
//! Files are hostile until read: what they declare is held against how long they are before any memory is asked for.

mod esri;
mod geotiff;
mod npz;
pub mod text;

use std::fs::File;
use std::path::{Path, PathBuf};

use thiserror::Error;

use antumbra_scene::Raster;

use crate::files::read_whole_file;

/// Bytes; no larger file is read.
const MAX_FILE_BYTES: u64 = 4 << 30;

/// The kinds of raster files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RasterFormat {
    /// Esri ASCII grid: `key value` lines in any order, then the values, north row first.
    Esri,
    /// GeoTIFF of one band.
    GeoTiff,
    /// NumPy arrays in a zip archive: the one with two dimensions is the elevation, north row first.
    Npz,
}

impl RasterFormat {
    /// The file name extensions that are known, for messages.
    pub const EXTENSIONS: &'static [&'static str] = &["asc", "npz", "tif", "tiff"];

    /// The format of a file with this extension, in either case of letters.
    #[must_use]
    pub fn from_extension(extension: &str) -> Option<Self> {
        match extension.to_ascii_lowercase().as_str() {
            "asc" => Some(Self::Esri),
            "npz" => Some(Self::Npz),
            "tif" | "tiff" => Some(Self::GeoTiff),
            _ => None,
        }
    }

    /// What people call it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Esri => "Esri ASCII raster",
            Self::GeoTiff => "GeoTIFF",
            Self::Npz => "NumPy archive",
        }
    }
}

/// Why a file gave no raster.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RasterError {
    /// The operating system refused.
    #[error("cannot read {}: {source}", file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The extension tells no format.
    #[error("{} ends in none of .{}: convert the file to one of them", file.display(), RasterFormat::EXTENSIONS.join(", ."))]
    UnknownExtension {
        /// The file.
        file: PathBuf,
    },
    /// The bytes do not follow the format.
    #[error("{}is no valid {}: {problem}", file.as_ref().map_or("this ".to_owned(), |file| format!("{} ", file.display())), format.name())]
    Format {
        /// The file; `None` when it was read from memory.
        file: Option<PathBuf>,
        /// What it should be.
        format: RasterFormat,
        /// What is wrong, and where.
        problem: String,
    },
}

/// Reads a raster from a file; its format is told by the extension.
///
/// # Errors
/// [`RasterError`]: what is wrong with the file, and where.
pub fn load_raster(file: &Path) -> Result<Raster, RasterError> {
    let extension = file.extension().and_then(|extension| extension.to_str());
    let format = extension.and_then(RasterFormat::from_extension);
    let format = format.ok_or_else(|| RasterError::UnknownExtension { file: file.into() })?;
    let opened = File::open(file);
    let bytes = opened.and_then(|opened| read_whole_file(opened, MAX_FILE_BYTES));
    let bytes = bytes.map_err(|source| RasterError::Io {
        file: file.into(),
        source,
    })?;
    read(format, &bytes).map_err(|problem| RasterError::Format {
        file: Some(file.into()),
        format,
        problem,
    })
}

/// Reads a raster from memory.
///
/// # Errors
/// [`RasterError::Format`]: what is wrong, and where.
pub fn load_raster_slice(format: RasterFormat, bytes: &[u8]) -> Result<Raster, RasterError> {
    read(format, bytes).map_err(|problem| RasterError::Format {
        file: None,
        format,
        problem,
    })
}

fn read(format: RasterFormat, bytes: &[u8]) -> Result<Raster, String> {
    match format {
        RasterFormat::Esri => esri::read(bytes),
        RasterFormat::GeoTiff => geotiff::read(bytes),
        RasterFormat::Npz => npz::read(bytes),
    }
}
