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
//! can be nothing else. [`SurfaceFile::notes`] says what was assumed. Files are treated as hostile: sizes that a file declares are checked against
//! its length before memory is allocated, and no file above [`MAX_FILE_BYTES`] is read.

mod budget;
mod byte_reader;
mod cps3;
mod delaunay;
mod eclipse;
mod faultroom;
mod format;
mod frame;
mod gocad;
mod irap;
mod irap_ascii;
mod numbered;
mod options;
mod picks;
mod roff;
mod roff_grid;
mod triangles;
mod zmap;

use std::path::Path;

use antumbra_formats::raster::RawRaster;
use antumbra_formats::{RasterError, RasterOptions, Units, load_raster_slice_with};
use antumbra_scene::Raster;

use crate::corner_point::{CellProperty, CornerPointGrid};
use crate::error::SubsurfaceError;
use crate::progress::ProgressFn;
use crate::surface::{Surface, SurfaceKind};
use budget::ReadBudget;
use format::{Format, in_words, unknown};
use numbered::Columns;

pub use options::{ReadOptions, ZPositive};

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

/// The surfaces of a file in metres, and what was assumed.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceFile {
    /// The surfaces, in the file's order.
    pub surfaces: Vec<Surface>,
    /// The latitude about which degrees were taken to metres; `None` for a file of lengths.
    pub latitude: Option<f64>,
    /// What was assumed or left out, a line each.
    pub notes: Vec<String>,
}

/// Reads the surfaces of a file as [`surfaces`] does, with what was assumed.
///
/// # Errors
/// As for [`surfaces`].
pub fn surface_file(
    path: &Path,
    options: &ReadOptions,
    progress: ProgressFn<'_>,
) -> Result<SurfaceFile, SubsurfaceError> {
    surface_file_from_bytes(path, &contents(path)?, options, progress)
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
    let format = Format::of(path, bytes).ok_or_else(|| unknown(path))?;
    let mut budget =
        ReadBudget::new(options, bytes.len()).map_err(|problem| format.error(path, problem))?;
    let read = Reading {
        stem: &stem(path),
        bytes,
        options,
        budget: &mut budget,
    }
    .file(format, progress);
    let file = read.map_err(|problem| format.error(path, problem))?;
    let count = file.surfaces.len() as u64;
    progress(count, count);
    Ok(file)
}

/// A file while it is read.
struct Reading<'a> {
    stem: &'a str,
    bytes: &'a [u8],
    options: &'a ReadOptions,
    budget: &'a mut ReadBudget,
}

impl Reading<'_> {
    fn file(mut self, format: Format, progress: ProgressFn<'_>) -> Result<SurfaceFile, String> {
        let Self { bytes, options, .. } = self;
        let down = options.z_positive.unwrap_or(ZPositive::Down);
        let up = options.z_positive.unwrap_or(ZPositive::Up);
        let kind = options.kind.unwrap_or(SurfaceKind::Fault);
        match format {
            Format::IrapBinary => self.horizon(irap::read(bytes, down)?),
            Format::IrapAscii => self.horizon(irap_ascii::read(bytes, down)?),
            Format::Zmap => {
                let raster = zmap::read(bytes, down, self.budget)?;
                self.horizon(raster)
            }
            Format::Cps3 => {
                let raster = cps3::read(bytes, down, self.budget)?;
                self.horizon(raster)
            }
            Format::Numbered(Columns::Lines) => {
                let raster = numbered::grid(bytes, down, self.budget)?;
                self.horizon(raster)
            }
            Format::Raster(format) => {
                let raster_options = RasterOptions {
                    max_memory: self.budget.left(),
                    units: options.units,
                    latitude: options.latitude,
                };
                let loaded = load_raster_slice_with(format, bytes, &raster_options);
                let mut loaded = loaded.map_err(|error| match error {
                    RasterError::Format { problem, .. } => problem,
                    other => other.to_string(),
                })?;
                if up == ZPositive::Down {
                    let heights = loaded.raster.elevation.iter_mut();
                    heights.for_each(|height| *height = -*height);
                }
                Ok(SurfaceFile {
                    surfaces: self.surface(&loaded.raster)?,
                    latitude: loaded.latitude,
                    notes: loaded.notes,
                })
            }
            Format::Numbered(Columns::Points) => {
                let points = numbered::points(bytes, up, self.budget)?;
                let surface = delaunay::surface(self.stem.into(), points, options.longest_edge)?;
                let mut file = self.in_metres(vec![surface], Units::default())?;
                if options.z_positive.is_none() {
                    let said = "it has no title: its columns are taken as x, y and a z that grows upwards (--positive down)";
                    file.notes.insert(0, said.to_owned());
                }
                Ok(file)
            }
            Format::Roff | Format::Eclipse(_) => {
                let GridFile { grid, notes } = self.grid(format)?;
                let [nx, ny, nz] = grid.size();
                let pillars = (u64::from(nx) + 1) * (u64::from(ny) + 1);
                self.budget.surfaces(u64::from(nz) + 1, pillars, || {
                    format!("the horizons of its {nz} layers, of {pillars} nodes each")
                })?;
                let surfaces = grid.surfaces(self.stem, progress);
                Ok(SurfaceFile {
                    surfaces: surfaces.map_err(|error| error.to_string())?,
                    latitude: None,
                    notes,
                })
            }
            Format::Gocad => {
                let positive = options.z_positive;
                let gocad::Objects { surfaces, said } =
                    gocad::read(bytes, self.stem, positive, kind, self.budget)?;
                self.in_metres(surfaces, said)
            }
            Format::Faultroom => {
                let surfaces = faultroom::read(bytes, down, kind, self.budget)?;
                self.in_metres(surfaces, Units::default())
            }
            Format::Picks => {
                let surfaces = picks::read(bytes, self.stem, options, self.budget, progress)?;
                self.in_metres(surfaces, Units::default())
            }
        }
    }

    /// The horizon over a raster in the file's units, of which the format says nothing.
    fn horizon(self, raster: Raster) -> Result<SurfaceFile, String> {
        let raw = RawRaster {
            raster,
            said: Units::default(),
            is_placed: true,
            notes: Vec::new(),
        };
        let (raster, frame) = raw.in_metres(self.options.units, self.options.latitude)?;
        Ok(SurfaceFile {
            surfaces: self.surface(&raster)?,
            latitude: frame.latitude,
            notes: frame.notes,
        })
    }

    fn surface(self, raster: &Raster) -> Result<Vec<Surface>, String> {
        let (columns, rows) = (raster.columns, raster.rows);
        let nodes = u64::from(columns) * u64::from(rows);
        self.budget.surfaces(1, nodes, || {
            format!("the horizon of its {columns} x {rows} nodes")
        })?;
        let surface = Surface::from_raster(raster, self.stem).map_err(|error| error.to_string());
        surface.map(|surface| vec![surface])
    }

    fn in_metres(self, mut surfaces: Vec<Surface>, said: Units) -> Result<SurfaceFile, String> {
        let frame = frame::in_metres(&mut surfaces, said, self.options)?;
        Ok(SurfaceFile {
            surfaces,
            latitude: frame.latitude,
            notes: frame.notes,
        })
    }

    fn grid(&mut self, format: Format) -> Result<GridFile, String> {
        let positive = self.options.z_positive.unwrap_or(ZPositive::Down);
        match format {
            Format::Roff => {
                let grid = roff_grid::grid(self.bytes, positive, self.budget)?;
                frame::grid_in_metres(grid, self.options)
            }
            Format::Eclipse(encoding) => {
                let read = eclipse::grid(self.bytes, encoding, self.options, self.budget)?;
                Ok(GridFile {
                    grid: read.grid,
                    notes: read.notes,
                })
            }
            other => Err(format!(
                "a {} is no grid of cells; give a ROFF grid (.roff) or an Eclipse grid (.grdecl, .egrid)",
                other.name()
            )),
        }
    }
}

/// A corner-point grid in metres, and what was assumed.
#[derive(Debug, Clone, PartialEq)]
pub struct GridFile {
    /// The grid.
    pub grid: CornerPointGrid,
    /// What was assumed or left out, a line each.
    pub notes: Vec<String>,
}

/// Reads the corner-point grid of a ROFF or an Eclipse file. [`property`] and [`property_of`] read values for its cells.
///
/// # Errors
/// As for [`surfaces`].
pub fn grid_file(path: &Path, options: &ReadOptions) -> Result<GridFile, SubsurfaceError> {
    grid_file_from_bytes(path, &contents(path)?, options)
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
    property_of_from_bytes(grid, path, &contents(path)?, name, options)
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
    property_from_bytes(path, &contents(path)?)
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
fn contents(path: &Path) -> Result<Vec<u8>, SubsurfaceError> {
    let contents = antumbra_files::read_whole_file(path, MAX_FILE_BYTES);
    contents.map_err(|source| SubsurfaceError::File {
        action: "read",
        path: path.into(),
        source,
    })
}
