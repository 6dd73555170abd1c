//! Sub-surface models out of files: surfaces, corner-point grids and what fills their cells.
//!
//! | file | what it is told by | becomes |
//! |---|---|---|
//! | Irap binary (`.gri`, `.irapbin`), Irap ASCII (`.irap`) | its first record, `-996` | a horizon |
//! | ROFF grid (`.roff`), binary or ASCII | `roff-bin`, `roff-asc` | a horizon for the top of each layer and one for the last's base |
//! | GOCAD TSurf (`.ts`) | `GOCAD TSurf` | a fault for each object |
//! | faultroom (`.json`) | `{` | a fault for each `FaultID` |
//! | Esri ASCII raster (`.asc`), GeoTIFF (`.tif`) | `ncols`, `II` or `MM` | a horizon |
//! | picks (`.csv`, `.txt`, `.tsv`, `.dat`) | its ending | a horizon for each surface named |
//!
//! Lengths are metres in a projected system; x is east, y north. Files are hostile until read: what they declare is held against how
//! long they are before any memory is asked for, and none above [`MAX_FILE_BYTES`] is read.

mod bytes;
mod drape;
mod faultroom;
mod gocad;
mod irap;
mod irap_ascii;
mod picks;
mod roff;
mod roff_grid;
mod triangles;

use std::fs::File;
use std::path::Path;

use antumbra_formats::{RasterError, RasterFormat, load_raster_slice, read_whole_file};
use antumbra_scene::Raster;

pub use crate::progress::Progress;

use crate::corner_point::{CellProperty, CornerPointGrid};
use crate::error::SubsurfaceError;
use crate::surface::{Surface, SurfaceKind};

/// Bytes; no larger file is read.
pub const MAX_FILE_BYTES: u64 = 4 << 30;

/// Which way a file's third coordinate grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ZPositive {
    /// Depths.
    Down,
    /// Elevations.
    Up,
}

impl ZPositive {
    /// Metres upwards, of what is written in the file.
    pub(crate) fn up(self, z: f64) -> f64 {
        match self {
            Self::Up => z,
            Self::Down => -z,
        }
    }
}

/// What a file does not say itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadOptions {
    /// Which way z grows. `None` is the format's custom: down in Irap, ROFF and faultroom files and in picks whose column is called a
    /// depth; what the file says in GOCAD; up in rasters and other picks.
    pub z_positive: Option<ZPositive>,
    /// What the surfaces of a triangle file (GOCAD, faultroom) are. `None` is a fault; as horizons they must be height fields.
    pub kind: Option<SurfaceKind>,
    /// Metres; triangles between picks with a longer edge are left out, so that holes and a concave outline stay. `None` is four times
    /// the median, over all triangles, of a triangle's longest edge.
    pub longest_edge: Option<f64>,
    /// The column that names a pick's surface. `None` finds it: see [`surfaces`].
    pub surface_column: Option<String>,
}

/// Every surface of a file, in its order; layers of a grid from the top down.
///
/// Undefined nodes, inactive cells and cells at places that are not finite are holes. Layers without an active cell are left out.
///
/// Of picks, the columns `x`, `y`, `z` (or easting, northing, elevation, depth) are found by their names whatever their case; the
/// surface's name is made of all columns called `surface`, `horizon`, `formation`, `feature_name`, `name` or `val`, and a row that leaves
/// one of those empty is no pick. Surfaces whose picks span no triangle are left out. Without such a column the picks make one surface. Picks at the same place become their mean.
///
/// # Errors
/// [`SubsurfaceError::File`] when it cannot be read, [`SubsurfaceError::Format`] when it is none of the formats above, truncated, lies
/// about its size, or holds nothing but undefined nodes.
pub fn surfaces(
    path: &Path,
    options: &ReadOptions,
    progress: Progress<'_>,
) -> Result<Vec<Surface>, SubsurfaceError> {
    surfaces_from_bytes(path, &contents(path)?, options, progress)
}

/// The same of a file's contents; the path gives names, and the format where the contents do not.
///
/// # Errors
/// As [`surfaces`].
pub fn surfaces_from_bytes(
    path: &Path,
    bytes: &[u8],
    options: &ReadOptions,
    progress: Progress<'_>,
) -> Result<Vec<Surface>, SubsurfaceError> {
    let format = Format::of(path, bytes).ok_or_else(|| unknown(path))?;
    let stem = stem(path);
    let down = options.z_positive.unwrap_or(ZPositive::Down);
    let up = options.z_positive.unwrap_or(ZPositive::Up);
    let horizon = |raster: Result<Raster, String>| {
        let surface = Surface::from_raster(&raster?, &stem).map_err(|error| error.to_string());
        surface.map(|surface| vec![surface])
    };
    let raster = |format| {
        let mut raster = load_raster_slice(format, bytes).map_err(|error| match error {
            RasterError::Format { problem, .. } => problem,
            other => other.to_string(),
        })?;
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
        Format::IrapBinary => horizon(irap::read(bytes, down)),
        Format::IrapAscii => horizon(irap_ascii::read(bytes, down)),
        Format::Esri => horizon(raster(RasterFormat::Esri)),
        Format::GeoTiff => horizon(raster(RasterFormat::GeoTiff)),
        Format::Roff => roff_grid::grid(bytes, down).and_then(|grid| {
            let surfaces = grid.surfaces(&stem, progress);
            surfaces.map_err(|error| error.to_string())
        }),
        Format::Gocad => gocad::read(bytes, &stem, options.z_positive, kind),
        Format::Faultroom => faultroom::read(bytes, down, kind),
        Format::Picks => picks::read(bytes, &stem, options, progress),
    };
    let surfaces = read.map_err(|problem| format.error(path, problem))?;
    let count = surfaces.len() as u64;
    progress(count, count);
    Ok(surfaces)
}

/// The corner-point grid of a ROFF file, to be filled with what [`property`] reads.
///
/// # Errors
/// As [`surfaces`].
pub fn grid(path: &Path, options: &ReadOptions) -> Result<CornerPointGrid, SubsurfaceError> {
    let positive = options.z_positive.unwrap_or(ZPositive::Down);
    let bytes = contents(path)?;
    roff_grid::grid(&bytes, positive).map_err(|problem| Format::Roff.error(path, problem))
}

/// The first parameter of a ROFF file: a value a cell. Codes, such as facies, are read as numbers.
///
/// # Errors
/// As [`surfaces`].
pub fn property(path: &Path) -> Result<CellProperty, SubsurfaceError> {
    property_from_bytes(path, &contents(path)?)
}

/// The same of a file's contents.
///
/// # Errors
/// As [`surfaces`].
pub fn property_from_bytes(path: &Path, bytes: &[u8]) -> Result<CellProperty, SubsurfaceError> {
    let error = |problem| SubsurfaceError::Format {
        path: path.into(),
        format: "ROFF parameter",
        problem,
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
            problem,
        }
    }

    /// By what it holds; where that says nothing, by its ending, so that the reader can say what is wrong.
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

/// A whole file, unless it is too large or may have no end.
fn contents(path: &Path) -> Result<Vec<u8>, SubsurfaceError> {
    let failed = |action| {
        move |source| SubsurfaceError::File {
            action,
            path: path.into(),
            source,
        }
    };
    let file = File::open(path).map_err(failed("open"))?;
    read_whole_file(file, MAX_FILE_BYTES).map_err(failed("read"))
}
