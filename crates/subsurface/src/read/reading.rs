//! A file's surfaces or its grid, read in the units of its format and taken to metres.

use antumbra_formats::raster::RawRaster;
use antumbra_formats::{RasterError, RasterOptions, SaidUnits, Units, load_raster_slice_with};
use antumbra_scene::Raster;

use super::budget::ReadBudget;
use super::delaunay::{self, PointSet};
use super::format::Format;
use super::numbered::Columns;
use super::options::{ReadOptions, ZPositive};
use super::{
    cps3, eclipse, faultroom, frame, gocad, irap, irap_ascii, numbered, picks, roff_grid, zmap,
};
use crate::corner_point::CornerPointGrid;
use crate::progress::ProgressFn;
use crate::surface::{Surface, SurfaceKind};

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

/// A corner-point grid in metres, and what was assumed.
#[derive(Debug, Clone, PartialEq)]
pub struct GridFile {
    /// The grid.
    pub grid: CornerPointGrid,
    /// What was assumed or left out, a line each.
    pub notes: Vec<String>,
}

/// A file while it is read.
pub(super) struct Reading<'a> {
    pub(super) stem: &'a str,
    pub(super) bytes: &'a [u8],
    /// What lies beside the file says of its units.
    pub(super) beside: SaidUnits,
    pub(super) options: &'a ReadOptions,
    pub(super) budget: &'a mut ReadBudget,
}

impl Reading<'_> {
    pub(super) fn file(
        mut self,
        format: Format,
        progress: ProgressFn<'_>,
    ) -> Result<SurfaceFile, String> {
        let Self { bytes, options, .. } = self;
        let down = options.z_positive.unwrap_or(ZPositive::Down);
        let up = options.z_positive.unwrap_or(ZPositive::Up);
        let kind = options.kind.unwrap_or(SurfaceKind::Fault);
        match format {
            Format::IrapBinary => {
                let raster = irap::read(bytes, down, self.budget)?;
                self.horizon(raster)
            }
            Format::IrapAscii => {
                let raster = irap_ascii::read(bytes, down, self.budget)?;
                self.horizon(raster)
            }
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
                self.budget.horizon(raster.columns, raster.rows)?;
                self.horizon(raster)
            }
            Format::Raster(format) => {
                let raster_options = RasterOptions {
                    // The reader takes the file's length, which is taken already.
                    max_memory: self.budget.left().saturating_add(bytes.len() as u64),
                    units: options.units,
                    beside: std::mem::take(&mut self.beside),
                    latitude: options.latitude,
                };
                let loaded = load_raster_slice_with(format, bytes, &raster_options);
                let mut loaded = loaded.map_err(|error| match error {
                    RasterError::Format { problem, .. } => problem,
                    other => other.to_string(),
                })?;
                // Its posts were paid for within what is left, and given back.
                self.budget
                    .horizon(loaded.raster.columns, loaded.raster.rows)?;
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
                let set = PointSet {
                    name: self.stem.into(),
                    points,
                };
                let mut file = self.triangulated(vec![set], progress)?;
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
                self.in_metres(surfaces, SaidUnits::default())
            }
            Format::Picks => {
                let picks = picks::read(bytes, self.stem, options, self.budget)?;
                self.triangulated(picks, progress)
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

    /// The horizon over a raster that is paid for.
    fn surface(self, raster: &Raster) -> Result<Vec<Surface>, String> {
        let surface = Surface::from_raster(raster, self.stem).map_err(|error| error.to_string());
        surface.map(|surface| vec![surface])
    }

    fn in_metres(self, mut surfaces: Vec<Surface>, said: SaidUnits) -> Result<SurfaceFile, String> {
        let frame = frame::in_metres(&mut surfaces, said.units, self.options)?;
        let notes = said.notes.into_iter().chain(frame.notes);
        Ok(SurfaceFile {
            surfaces,
            latitude: frame.latitude,
            notes: notes.collect(),
        })
    }

    /// The horizons over points in the file's units. They are taken to metres first, in which edges are measured.
    fn triangulated(
        self,
        mut sets: Vec<PointSet>,
        progress: ProgressFn<'_>,
    ) -> Result<SurfaceFile, String> {
        let frame = frame::points_in_metres(&mut sets, self.options)?;
        Ok(SurfaceFile {
            surfaces: delaunay::surfaces(sets, self.options.longest_edge, progress)?,
            latitude: frame.latitude,
            notes: frame.notes,
        })
    }

    pub(super) fn grid(&mut self, format: Format) -> Result<GridFile, String> {
        let positive = self.options.z_positive.unwrap_or(ZPositive::Down);
        match format {
            Format::Roff => {
                let grid = roff_grid::grid(self.bytes, positive, self.budget)?;
                let (grid, notes) = frame::grid_in_metres(grid, self.options)?;
                Ok(GridFile { grid, notes })
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
