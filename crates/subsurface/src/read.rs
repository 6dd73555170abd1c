//! Reading of sub-surface models from files: surfaces, corner-point grids and properties of their cells.
//!
//! | file | recognised by | becomes |
//! |---|---|---|
//! | Irap binary (`.gri`, `.irapbin`), Irap ASCII (`.irap`) | its first record, `-996` | a horizon |
//! | ZMAP+ (`.zmap`, `.map`), CPS-3 (`.cps3`) | a line `@`..., GRID; `FSASCI` | a horizon |
//! | ROFF grid (`.roff`), binary or ASCII | `roff-bin`, `roff-asc` | a horizon for the top of each layer and one for the last layer's base |
//! | Eclipse grid (`.grdecl`; `.egrid`, binary `.grdecl`) | its extension; a record of 16 bytes | the same |
//! | GOCAD TSurf (`.ts`) | `GOCAD TSurf` | a fault for each object |
//! | faultroom (`.json`) | `{` | a fault for each `FaultID` |
//! | Esri ASCII raster (`.asc`), GeoTIFF (`.tif`), Surfer grid (`.grd`), NumPy (`.npz`) | `ncols`, `II` or `MM`, `DS..`, its extension | a horizon |
//! | picks (`.csv`, `.txt`, `.tsv`, `.dat`) | its extension | a horizon for each surface named |
//! | points without a title (`.xyz`, `.poi` and those of picks) | its extension; lines of numbers | a horizon |
//! | IJXYZ: inline, crossline, x, y, z (`.dat`, `.map`, `.ijxyz`) | its extension; lines of five numbers | a horizon on the grid of the lines |
//!
//! x is east, y north. Units are those that [`ReadOptions::units`] names, else the file's; where it names none, metres, or degrees if its places
//! can be nothing else. [`SurfaceFile::notes`] says what was assumed. Files are treated as hostile: before memory is allocated, sizes that a file
//! declares are checked against its length, or, in texts that may repeat a value, against the memory that is allowed. No file above
//! [`MAX_FILE_BYTES`] is read.

mod budget;
mod byte_reader;
mod column_grid;
mod cps3;
mod delaunay;
mod eclipse;
mod faultroom;
mod format;
pub(crate) mod frame;
mod gocad;
mod irap;
mod irap_ascii;
mod numbered;
mod options;
mod picks;
mod reading;
mod roff;
mod roff_grid;
mod triangles;
mod zmap;

use std::path::Path;

use antumbra_files::{default_memory, read_whole_file_within};
use antumbra_formats::SaidUnits;
use antumbra_formats::raster::units_beside;

use crate::corner_point::{CellProperty, CornerPointGrid};
use crate::error::SubsurfaceError;
use crate::progress::ProgressFn;
use crate::surface::Surface;
use budget::ReadBudget;
use format::{Format, in_words, unknown};
use reading::Reading;

pub use options::{ReadOptions, ZPositive};
pub use reading::{GridFile, SurfaceFile};

/// The greatest size of a file in bytes.
pub const MAX_FILE_BYTES: u64 = 4 << 30;

/// Reads every surface of a file, in the file's order. Layers of a grid go from the top down.
///
/// Undefined nodes, inactive cells, and cells at positions that are not finite are holes. Layers without an active
/// cell are left out.
///
/// In a table of picks the columns `x`, `y`, `z` (or easting, northing, elevation, depth) are found by name, without
/// regard to case. The surface's name is made of all columns called `surface`, `horizon`, `formation`,
/// `feature_name`, `name` or `val`, and a row with one of them empty is skipped. Without such a column all picks make
/// one surface. Picks at the same place are averaged. Surfaces whose picks span no triangle are left out.
///
/// # Errors
/// [`SubsurfaceError::File`] if the file cannot be read, [`SubsurfaceError::Format`] if it is in none of the formats
/// above, is truncated, declares a wrong size, or has only undefined nodes.
pub fn surfaces(
    path: &Path,
    options: &ReadOptions,
    progress: ProgressFn<'_>,
) -> Result<Vec<Surface>, SubsurfaceError> {
    surface_file(path, options, progress).map(|file| file.surfaces)
}

/// Reads surfaces from the contents of a file. The path gives names, and the format where the contents do not.
///
/// # Errors
/// As for [`surfaces`].
pub fn surfaces_from_bytes(
    path: &Path,
    bytes: &[u8],
    options: &ReadOptions,
    progress: ProgressFn<'_>,
) -> Result<Vec<Surface>, SubsurfaceError> {
    surface_file_from_bytes(path, bytes, options, progress).map(|file| file.surfaces)
}

/// Reads the surfaces of a file as [`surfaces`] does, with what was assumed. A `.prj` file beside a raster is asked for units that the raster
/// itself does not name.
///
/// # Errors
/// As for [`surfaces`].
pub fn surface_file(
    path: &Path,
    options: &ReadOptions,
    progress: ProgressFn<'_>,
) -> Result<SurfaceFile, SubsurfaceError> {
    let contents = contents(path, options.max_memory)?;
    surface_file_with(path, &contents, units_beside(path), options, progress)
}

/// Reads the surfaces of the contents of a file as [`surfaces_from_bytes`] does, with what was assumed.
///
/// # Errors
/// As for [`surfaces`].
pub fn surface_file_from_bytes(
    path: &Path,
    bytes: &[u8],
    options: &ReadOptions,
    progress: ProgressFn<'_>,
) -> Result<SurfaceFile, SubsurfaceError> {
    surface_file_with(path, bytes, SaidUnits::default(), options, progress)
}

/// Reads surfaces, with the units that lie beside the file.
fn surface_file_with(
    path: &Path,
    bytes: &[u8],
    beside: SaidUnits,
    options: &ReadOptions,
    progress: ProgressFn<'_>,
) -> Result<SurfaceFile, SubsurfaceError> {
    let format = Format::of(path, bytes).ok_or_else(|| unknown(path))?;
    let mut budget =
        ReadBudget::new(options, bytes.len()).map_err(|problem| format.error(path, problem))?;
    let read = Reading {
        stem: &stem(path),
        bytes,
        beside,
        options,
        budget: &mut budget,
    }
    .file(format, progress);
    let file = read.map_err(|problem| format.error(path, problem))?;
    let count = file.surfaces.len() as u64;
    progress(count, count);
    Ok(file)
}

/// Reads the corner-point grid of a ROFF or an Eclipse file. [`property`] and [`property_of`] read values for its cells.
///
/// # Errors
/// As for [`surfaces`].
pub fn grid_file(path: &Path, options: &ReadOptions) -> Result<GridFile, SubsurfaceError> {
    grid_file_from_bytes(path, &contents(path, options.max_memory)?, options)
}

/// Reads a corner-point grid from the contents of a file, as [`grid_file`] does.
///
/// # Errors
/// As for [`surfaces`].
pub fn grid_file_from_bytes(
    path: &Path,
    bytes: &[u8],
    options: &ReadOptions,
) -> Result<GridFile, SubsurfaceError> {
    let format = Format::of(path, bytes).ok_or_else(|| unknown(path))?;
    let read = ReadBudget::new(options, bytes.len()).and_then(|mut budget| {
        let mut reading = Reading {
            stem: "",
            bytes,
            beside: SaidUnits::default(),
            options,
            budget: &mut budget,
        };
        reading.grid(format)
    });
    read.map_err(|problem| format.error(path, problem))
}

/// Reads the corner-point grid of a ROFF or an Eclipse file, as [`grid_file`] does.
///
/// # Errors
/// As for [`surfaces`].
pub fn grid(path: &Path, options: &ReadOptions) -> Result<CornerPointGrid, SubsurfaceError> {
    grid_file(path, options).map(|file| file.grid)
}

/// Reads a property of the cells of `grid`: of a ROFF file, or of an Eclipse text, `.init` or restart file. `name` chooses among several; in a
/// restart file the last step counts.
///
/// # Errors
/// As for [`surfaces`], and for a file without such a property.
pub fn property_of(
    grid: &CornerPointGrid,
    path: &Path,
    name: Option<&str>,
    options: &ReadOptions,
) -> Result<CellProperty, SubsurfaceError> {
    property_of_from_bytes(
        grid,
        path,
        &contents(path, options.max_memory)?,
        name,
        options,
    )
}

/// Reads a property from the contents of a file, as [`property_of`] does.
///
/// # Errors
/// As for [`property_of`].
pub fn property_of_from_bytes(
    grid: &CornerPointGrid,
    path: &Path,
    bytes: &[u8],
    name: Option<&str>,
    options: &ReadOptions,
) -> Result<CellProperty, SubsurfaceError> {
    let error = |problem| SubsurfaceError::Format {
        path: path.into(),
        format: "file of cell properties",
        problem: in_words(problem),
    };
    let encoding = match Format::of(path, bytes) {
        Some(Format::Roff) => return roff_grid::property(bytes, name).map_err(error),
        Some(Format::Eclipse(encoding)) => encoding,
        // A part of a grid's text may have any name.
        _ => eclipse::Encoding::Text,
    };
    let read = ReadBudget::new(options, bytes.len())
        .and_then(|mut budget| eclipse::property(bytes, encoding, name, grid, &mut budget));
    read.map_err(error)
}

/// Reads the first parameter of a ROFF file: one value per cell. Codes, such as facies, are read as numbers.
///
/// # Errors
/// As for [`surfaces`].
pub fn property(path: &Path) -> Result<CellProperty, SubsurfaceError> {
    property_from_bytes(path, &contents(path, None)?)
}

/// Reads a parameter from the contents of a ROFF file.
///
/// # Errors
/// As for [`surfaces`].
pub fn property_from_bytes(path: &Path, bytes: &[u8]) -> Result<CellProperty, SubsurfaceError> {
    let error = |problem| SubsurfaceError::Format {
        path: path.into(),
        format: "ROFF parameter",
        problem: in_words(problem),
    };
    roff_grid::property(bytes, None).map_err(error)
}

fn stem(path: &Path) -> String {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy());
    stem.map_or_else(|| "surface".into(), |stem| stem.into_owned())
}

/// The contents of a file, unless it is too large or not a regular file.
fn contents(path: &Path, max_memory: Option<u64>) -> Result<Vec<u8>, SubsurfaceError> {
    let memory = max_memory.unwrap_or_else(default_memory);
    let contents = read_whole_file_within(path, MAX_FILE_BYTES, memory);
    contents.map_err(|source| SubsurfaceError::File {
        action: "read",
        path: path.into(),
        source,
    })
}
