//! Reading of sub-surface models from files: surfaces, corner-point grids and properties of their cells.
//!
//! | file | recognised by | becomes |
//! |---|---|---|
//! | Irap binary (`.gri`, `.irapbin`), Irap ASCII (`.irap`) | its first record, `-996` | a horizon |
//! | ROFF grid (`.roff`), binary or ASCII | `roff-bin`, `roff-asc` | a horizon for the top of each layer and one for the last layer's base |
//! | GOCAD TSurf (`.ts`) | `GOCAD TSurf` | a fault for each object |
//! | faultroom (`.json`) | `{` | a fault for each `FaultID` |
//! | Esri ASCII raster (`.asc`), GeoTIFF (`.tif`) | `ncols`, `II` or `MM` | a horizon |
//! | picks (`.csv`, `.txt`, `.tsv`, `.dat`) | its extension | a horizon for each surface named |
//!
//! Lengths are metres in a projected coordinate system; x is east, y north. Files are treated as hostile: sizes that
//! a file declares are checked against its length before memory is allocated, and no file above [`MAX_FILE_BYTES`] is
//! read.

mod budget;
mod byte_reader;
mod delaunay;
mod faultroom;
mod gocad;
mod irap;
mod irap_ascii;
mod options;
mod picks;
mod roff;
mod roff_grid;
mod triangles;

use std::path::Path;

use antumbra_files::{default_memory, read_whole_file_within, words};
use antumbra_formats::{RasterError, RasterFormat, load_raster_slice_within};
use antumbra_scene::Raster;

use crate::corner_point::{CellProperty, CornerPointGrid};
use crate::error::SubsurfaceError;
use crate::progress::ProgressFn;
use crate::surface::{Surface, SurfaceKind};
use budget::ReadBudget;

pub use options::{ReadOptions, ZPositive};

/// Letters of a problem in a message, since it may quote the file.
const MOST_LETTERS: usize = 400;

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
    surfaces_from_bytes(
        path,
        &contents(path, options.max_memory)?,
        options,
        progress,
    )
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
    let format = Format::of(path, bytes).ok_or_else(|| unknown(path))?;
    let stem = stem(path);
    let down = options.z_positive.unwrap_or(ZPositive::Down);
    let up = options.z_positive.unwrap_or(ZPositive::Up);
    let mut budget =
        ReadBudget::new(options, bytes.len()).map_err(|problem| format.error(path, problem))?;
    let budget = &mut budget;
    let horizon = |raster: Raster| {
        let surface = Surface::from_raster(&raster, &stem).map_err(|error| error.to_string());
        surface.map(|surface| vec![surface])
    };
    // Its posts are paid for within what is left, and given back.
    let raster = |format, budget: &mut ReadBudget| {
        let raster = load_raster_slice_within(format, bytes, budget.left());
        let mut raster = raster.map_err(|error| match error {
            RasterError::Format { problem, .. } => problem,
            other => other.to_string(),
        })?;
        budget.horizon(raster.columns, raster.rows)?;
        if up == ZPositive::Down {
            raster
                .elevation
                .iter_mut()
                .for_each(|height| *height = -*height);
        }
        Ok(raster)
    };
    let kind = options.kind.unwrap_or(SurfaceKind::Fault);
    let read = match format {
        Format::IrapBinary => irap::read(bytes, down, budget).and_then(horizon),
        Format::IrapAscii => irap_ascii::read(bytes, down, budget).and_then(horizon),
        Format::Esri => raster(RasterFormat::Esri, budget).and_then(horizon),
        Format::GeoTiff => raster(RasterFormat::GeoTiff, budget).and_then(horizon),
        Format::Roff => roff_grid::grid(bytes, down, budget).and_then(|grid| {
            let [nx, ny, nz] = grid.size();
            let pillars = (u64::from(nx) + 1) * (u64::from(ny) + 1);
            budget.surfaces(u64::from(nz) + 1, pillars, || {
                format!("the horizons of its {nz} layers, of {pillars} nodes each")
            })?;
            let surfaces = grid.surfaces(&stem, progress);
            surfaces.map_err(|error| error.to_string())
        }),
        Format::Gocad => gocad::read(bytes, &stem, options.z_positive, kind, budget),
        Format::Faultroom => faultroom::read(bytes, down, kind, budget),
        Format::Picks => picks::read(bytes, &stem, options, budget, progress),
    };
    let surfaces = read.map_err(|problem| format.error(path, problem))?;
    let count = surfaces.len() as u64;
    progress(count, count);
    Ok(surfaces)
}

/// Reads the corner-point grid of a ROFF file. [`property`] reads values for its cells.
///
/// # Errors
/// As for [`surfaces`].
pub fn grid(path: &Path, options: &ReadOptions) -> Result<CornerPointGrid, SubsurfaceError> {
    let positive = options.z_positive.unwrap_or(ZPositive::Down);
    let bytes = contents(path, options.max_memory)?;
    let grid = ReadBudget::new(options, bytes.len())
        .and_then(|mut budget| roff_grid::grid(&bytes, positive, &mut budget));
    grid.map_err(|problem| Format::Roff.error(path, problem))
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
    let error = |problem: String| SubsurfaceError::Format {
        path: path.into(),
        format: "ROFF parameter",
        problem: words::short(&problem, MOST_LETTERS),
    };
    roff_grid::property(bytes).map_err(error)
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    IrapBinary,
    IrapAscii,
    Roff,
    Gocad,
    Faultroom,
    Esri,
    GeoTiff,
    Picks,
}

impl Format {
    fn name(self) -> &'static str {
        match self {
            Self::IrapBinary => "Irap binary surface",
            Self::IrapAscii => "Irap ASCII surface",
            Self::Roff => "ROFF grid",
            Self::Gocad => "GOCAD TSurf",
            Self::Faultroom => "faultroom file",
            Self::Esri => "Esri ASCII raster",
            Self::GeoTiff => "GeoTIFF",
            Self::Picks => "table of picks",
        }
    }

    fn error(self, path: &Path, problem: String) -> SubsurfaceError {
        SubsurfaceError::Format {
            path: path.into(),
            format: self.name(),
            problem: words::short(&problem, MOST_LETTERS),
        }
    }

    /// Recognises the format by the contents, or else by the extension, so that the reader can report what is wrong.
    fn of(path: &Path, bytes: &[u8]) -> Option<Self> {
        let begin = bytes.trim_ascii_start();
        let begins = |with: &[u8]| {
            let start = begin.get(..with.len());
            start.is_some_and(|start| start.eq_ignore_ascii_case(with))
        };
        let magic: [(&[u8], Self); 10] = [
            (b"roff-bin", Self::Roff),
            (b"roff-asc", Self::Roff),
            (b"gocad tsurf", Self::Gocad),
            (b"{", Self::Faultroom),
            (b"-996", Self::IrapAscii),
            (b"ncols", Self::Esri),
            (b"II*\0", Self::GeoTiff),
            (b"II+\0", Self::GeoTiff),
            (b"MM\0*", Self::GeoTiff),
            (b"MM\0+", Self::GeoTiff),
        ];
        if bytes.starts_with(&irap::MAGIC) {
            return Some(Self::IrapBinary);
        }
        if let Some((_, format)) = magic.iter().find(|(with, _)| begins(with)) {
            return Some(*format);
        }
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        Some(match ending.as_str() {
            "gri" | "irapbin" => Self::IrapBinary,
            "irap" => Self::IrapAscii,
            "roff" => Self::Roff,
            "ts" => Self::Gocad,
            "json" => Self::Faultroom,
            "asc" => Self::Esri,
            "tif" | "tiff" => Self::GeoTiff,
            "csv" | "tsv" | "txt" | "dat" => Self::Picks,
            _ => return None,
        })
    }
}

fn unknown(path: &Path) -> SubsurfaceError {
    let problem = "it is none of Irap (.gri, .irapbin, .irap), ROFF grid (.roff), GOCAD TSurf (.ts), faultroom (.json), raster (.asc, \
                   .tif) and picks (.csv, .tsv, .txt, .dat)";
    SubsurfaceError::Format {
        path: path.into(),
        format: "surface file",
        problem: problem.into(),
    }
}

fn stem(path: &Path) -> String {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy());
    stem.map_or_else(|| "surface".into(), |stem| stem.into_owned())
}

/// The contents of a file, unless it is too large for the memory of its load, or not a regular file.
fn contents(path: &Path, max_memory: Option<u64>) -> Result<Vec<u8>, SubsurfaceError> {
    let memory = max_memory.unwrap_or_else(default_memory);
    let contents = read_whole_file_within(path, MAX_FILE_BYTES, memory);
    contents.map_err(|source| SubsurfaceError::File {
        action: "read",
        path: path.into(),
        source,
    })
}
