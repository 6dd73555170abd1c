//! Rasters: elevations on a regular grid, from Esri ASCII grids, GeoTIFF, NumPy files and Surfer grids.
//!
//! Files are treated as hostile: sizes that a file declares are checked against its length before memory is
//! allocated.

mod esri;
mod frame;
mod geotiff;
mod npz;
mod projection_file;
mod surfer;
pub mod text;
mod tiff_directory;

use std::path::{Path, PathBuf};

use thiserror::Error;

use antumbra_files::{MemoryBudget, OverBudget, default_memory, read_whole_file_within, words};
use antumbra_scene::Raster;

use crate::units::{SaidUnits, Units};

pub use frame::{Extent, Frame, Known, RawRaster};
pub use projection_file::units_beside;

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
    /// Surfer grid, ASCII (`DSAA`) or binary (`DSBB`, `DSRB`).
    Surfer,
}

impl RasterFormat {
    /// The known file name extensions, for messages.
    pub const EXTENSIONS: &'static [&'static str] = &["asc", "grd", "npz", "tif", "tiff"];

    /// The format with this file name extension, in upper or lower case.
    #[must_use]
    pub fn from_extension(extension: &str) -> Option<Self> {
        match extension.to_ascii_lowercase().as_str() {
            "asc" => Some(Self::Esri),
            "grd" => Some(Self::Surfer),
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
            Self::Surfer => "Surfer grid",
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

/// How a raster is read.
#[derive(Debug, Clone, PartialEq)]
pub struct RasterOptions {
    /// Bytes of memory of the posts, with what is made of them. By default half of what the machine has free.
    pub max_memory: u64,
    /// Units that replace those that the file names. By default those of the file; where it names none, degrees if its places can only be degrees,
    /// else metres.
    pub units: Units,
    /// Units of what lies beside the file, for those that the file itself does not name. [`load_raster_with`] asks a `.prj` file where these say nothing;
    /// a caller that reads from memory finds them with [`units_beside`].
    pub beside: SaidUnits,
    /// The latitude, in degrees, about which degrees are taken to metres. By default the middle of the file's own; rasters that shall lie beside
    /// each other need one.
    pub latitude: Option<f64>,
}

impl Default for RasterOptions {
    fn default() -> Self {
        Self {
            max_memory: default_memory(),
            units: Units::default(),
            beside: SaidUnits::default(),
            latitude: None,
        }
    }
}

/// A raster in metres, and what was done about its units.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedRaster {
    /// The raster.
    pub raster: Raster,
    /// The latitude about which degrees were taken to metres; `None` for a raster that was in lengths.
    pub latitude: Option<f64>,
    /// What was assumed or changed, a line each.
    pub notes: Vec<String>,
}

/// Reads a raster from a file, in metres. The extension determines the format. It may take half of the memory that the machine has free.
///
/// # Errors
/// [`RasterError`], with the problem and its place.
pub fn load_raster(file: &Path) -> Result<Raster, RasterError> {
    load_raster_with(file, &RasterOptions::default()).map(|loaded| loaded.raster)
}

/// As [`load_raster`], with options, and with what was assumed. A `.prj` file beside the raster is asked for units that the raster itself does not
/// name.
///
/// # Errors
/// [`RasterError`], with the problem and its place.
pub fn load_raster_with(file: &Path, options: &RasterOptions) -> Result<LoadedRaster, RasterError> {
    let extension = file.extension().and_then(|extension| extension.to_str());
    let format = extension.and_then(RasterFormat::from_extension);
    let format = format.ok_or_else(|| RasterError::UnknownExtension { file: file.into() })?;
    let bytes = read_whole_file_within(file, MAX_FILE_BYTES, options.max_memory);
    let bytes = bytes.map_err(|source| RasterError::Io {
        file: file.into(),
        source,
    })?;
    let found;
    let beside = match options.beside.units == Units::default() {
        true => {
            found = units_beside(file);
            &found
        }
        false => &options.beside,
    };
    read(format, bytes, options, beside).map_err(|problem| RasterError::Format {
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
    load_raster_slice_with(format, bytes, &RasterOptions::default()).map(|loaded| loaded.raster)
}

/// Reads a raster from memory, as [`load_raster_with`] does.
///
/// # Errors
/// [`RasterError::Format`], with the problem and its place.
pub fn load_raster_slice_with(
    format: RasterFormat,
    bytes: &[u8],
    options: &RasterOptions,
) -> Result<LoadedRaster, RasterError> {
    read(format, bytes, options, &options.beside).map_err(|problem| RasterError::Format {
        file: None,
        format,
        problem: words::short(&problem, MOST_LETTERS),
    })
}

/// The raster of a file's bytes, which are given back as soon as it is read.
fn read(
    format: RasterFormat,
    bytes: impl AsRef<[u8]>,
    options: &RasterOptions,
    beside: &SaidUnits,
) -> Result<LoadedRaster, String> {
    let mut memory = MemoryBudget::new(options.max_memory);
    let text = |over: OverBudget| over.to_string();
    let contents = bytes.as_ref();
    memory
        .take(contents.len() as u64, || "the file")
        .map_err(text)?;
    let raw = match format {
        RasterFormat::Esri => esri::read(contents, &mut memory),
        RasterFormat::GeoTiff => geotiff::read(contents, &mut memory),
        RasterFormat::Npz => npz::read(contents, &mut memory),
        RasterFormat::Surfer => surfer::read(contents, &mut memory),
    }?;
    drop(bytes);
    let said = raw.said.or(beside.units);
    let notes = beside.notes.iter().cloned().chain(raw.notes);
    let raw = RawRaster {
        said,
        notes: notes.collect(),
        ..raw
    };
    let (raster, frame) = raw.in_metres(options.units, options.latitude)?;
    Ok(LoadedRaster {
        raster,
        latitude: frame.latitude,
        notes: frame.notes,
    })
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
