//! Rasters: elevations on a regular grid, from Esri ASCII grids, GeoTIFF and NumPy files.
//!
//! Files are treated as hostile: sizes that a file declares are checked against its length before memory is
//! allocated.

mod esri;
mod geotiff;
mod npz;
pub mod text;
mod tiff_directory;

use std::path::{Path, PathBuf};

use thiserror::Error;

use antumbra_files::{MemoryBudget, OverBudget, default_memory, read_whole_file_within, words};
use antumbra_scene::Raster;

/// Letters of a problem in a message, since it may quote the file.
const MOST_LETTERS: usize = 400;

/// The greatest size of a file in bytes.
const MAX_FILE_BYTES: u64 = 4 << 30;

/// The raster formats.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RasterFormat {
    /// Esri ASCII grid: `key value` lines in any order, then the values, north row first.
    Esri,
    /// GeoTIFF with one band.
    GeoTiff,
    /// NumPy arrays in a zip archive. The array with two dimensions is the elevation, north row first.
    Npz,
}

impl RasterFormat {
    /// The known file name extensions, for messages.
    pub const EXTENSIONS: &'static [&'static str] = &["asc", "npz", "tif", "tiff"];

    /// The format with this file name extension, in upper or lower case.
    #[must_use]
    pub fn from_extension(extension: &str) -> Option<Self> {
        match extension.to_ascii_lowercase().as_str() {
            "asc" => Some(Self::Esri),
            "npz" => Some(Self::Npz),
            "tif" | "tiff" => Some(Self::GeoTiff),
            _ => None,
        }
    }

    /// The format's name, for messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Esri => "Esri ASCII raster",
            Self::GeoTiff => "GeoTIFF",
            Self::Npz => "NumPy archive",
        }
    }
}

/// Why a raster could not be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RasterError {
    /// The operating system reported an error.
    #[error("cannot read {}: {source}", file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file name extension is unknown.
    #[error("{} has none of the extensions .{}: convert the file to one of these formats", file.display(), RasterFormat::EXTENSIONS.join(", ."))]
    UnknownExtension {
        /// The file.
        file: PathBuf,
    },
    /// The contents are invalid.
    #[error("{}is not a valid {}: {problem}", file.as_ref().map_or("this ".to_owned(), |file| format!("{} ", file.display())), format.name())]
    Format {
        /// The file; `None` if it was read from memory.
        file: Option<PathBuf>,
        /// The expected format.
        format: RasterFormat,
        /// The problem and its place.
        problem: String,
    },
}

/// Bytes of memory that a post becomes: its elevation, and while a terrain or a horizon is made of it, its position and its error.
const POST: u64 = 32;

/// Reads a raster from a file. The extension determines the format. It may take half of the memory that the machine has free.
///
/// # Errors
/// [`RasterError`], with the problem and its place.
pub fn load_raster(file: &Path) -> Result<Raster, RasterError> {
    load_raster_within(file, default_memory())
}

/// As [`load_raster`], in `max_memory` bytes, with what is made of the posts.
///
/// # Errors
/// [`RasterError`], with the problem and its place.
pub fn load_raster_within(file: &Path, max_memory: u64) -> Result<Raster, RasterError> {
    let extension = file.extension().and_then(|extension| extension.to_str());
    let format = extension.and_then(RasterFormat::from_extension);
    let format = format.ok_or_else(|| RasterError::UnknownExtension { file: file.into() })?;
    let bytes = read_whole_file_within(file, MAX_FILE_BYTES, max_memory);
    let bytes = bytes.map_err(|source| RasterError::Io {
        file: file.into(),
        source,
    })?;
    read(format, &bytes, max_memory).map_err(|problem| RasterError::Format {
        file: Some(file.into()),
        format,
        problem: words::short(&problem, MOST_LETTERS),
    })
}

/// Reads a raster from memory, as [`load_raster`] does.
///
/// # Errors
/// [`RasterError::Format`], with the problem and its place.
pub fn load_raster_slice(format: RasterFormat, bytes: &[u8]) -> Result<Raster, RasterError> {
    load_raster_slice_within(format, bytes, default_memory())
}

/// Reads a raster from memory, as [`load_raster_within`] does.
///
/// # Errors
/// [`RasterError::Format`], with the problem and its place.
pub fn load_raster_slice_within(
    format: RasterFormat,
    bytes: &[u8],
    max_memory: u64,
) -> Result<Raster, RasterError> {
    read(format, bytes, max_memory).map_err(|problem| RasterError::Format {
        file: None,
        format,
        problem: words::short(&problem, MOST_LETTERS),
    })
}

fn read(format: RasterFormat, bytes: &[u8], max_memory: u64) -> Result<Raster, String> {
    let mut memory = MemoryBudget::new(max_memory);
    let text = |over: OverBudget| over.to_string();
    memory
        .take(bytes.len() as u64, || "the file")
        .map_err(text)?;
    match format {
        RasterFormat::Esri => esri::read(bytes, &mut memory),
        RasterFormat::GeoTiff => geotiff::read(bytes, &mut memory),
        RasterFormat::Npz => npz::read(bytes, &mut memory),
    }
}

/// Takes the memory of a grid's posts, `decoded` bytes each while they are read.
fn take_posts(
    memory: &mut MemoryBudget,
    columns: u32,
    rows: u32,
    decoded: u64,
) -> Result<(), String> {
    let posts = u64::from(columns) * u64::from(rows);
    let bytes = posts.saturating_mul(POST + decoded);
    let taken = memory.take(bytes, || format!("its {columns} x {rows} posts"));
    taken.map_err(|over| over.to_string())
}
