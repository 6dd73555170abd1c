//! Corner-point grids and cell properties of reservoir simulators that follow Eclipse: text (`.grdecl`) and binary (`.egrid`, `.init`, `.unrst`,
//! binary `.grdecl`).
//!
//! Cells are ordered with the first index fastest, then the second; the third grows downwards. `COORD` has two points of each pillar, `ZCORN` the
//! depths of the eight corners of each cell. `MAPAXES` says where a grid's own axes lie on the map.

mod binary;
mod text;

use antumbra_files::words::name;
use antumbra_formats::raster::{Extent, Frame, Known};
use antumbra_formats::{LengthUnit, PlanUnit, SaidUnits, Units};
use glam::{DVec2, DVec3};

use super::budget::ReadBudget;
use super::options::{ReadOptions, ZPositive};
use crate::corner_point::{CellProperty, CornerPointGrid, Pillar};

/// Numbers of a pillar, and depths of a cell's corners.
const PILLAR: usize = 6;
const CORNERS: usize = 8;

/// The most notes about a grid, and the words of a keyword that names a unit which are read.
const MOST_NOTES: usize = 64;
const UNIT_WORDS: usize = 8;

/// The layouts of such files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    Binary,
}

/// The parts of a grid, as a file has them.
#[derive(Debug, Default)]
struct Parts {
    size: Option<[u32; 3]>,
    coord: Vec<f32>,
    zcorn: Vec<f32>,
    /// Nothing where all cells are active.
    active: Option<Vec<bool>>,
    map_axes: Option<[f64; 6]>,
    map_unit: Option<LengthUnit>,
    grid_unit: Option<LengthUnit>,
    /// Whether the pillars are on the map already.
    is_on_map: bool,
    notes: Vec<String>,
}

/// A grid in metres, and what was assumed.
pub(super) struct EclipseGrid {
    pub(super) grid: CornerPointGrid,
    pub(super) notes: Vec<String>,
}

/// Reads a grid.
pub(super) fn grid(
    bytes: &[u8],
    encoding: Encoding,
    options: &ReadOptions,
    budget: &mut ReadBudget,
) -> Result<EclipseGrid, String> {
    let parts = match encoding {
        Encoding::Text => text::grid(bytes, budget),
        Encoding::Binary => binary::grid(bytes, budget),
    }?;
    parts.grid(options)
}

/// Reads a property of a grid's cells: the one called `wanted`, or the only one of the file.
pub(super) fn property(
    bytes: &[u8],
    encoding: Encoding,
    wanted: Option<&str>,
    grid: &CornerPointGrid,
    budget: &mut ReadBudget,
) -> Result<CellProperty, String> {
    let size = grid.size();
    let cells = cells(size)?;
    let (found, values) = match encoding {
        Encoding::Text => text::property(bytes, wanted, cells, budget),
        Encoding::Binary => binary::property(bytes, wanted, [grid.active_cells(), cells], budget),
    }?;
    budget.take(cells as u64 * 4, || format!("its property {found}"))?;
    let mut property = CellProperty {
        name: found,
        size,
        values: vec![f32::NAN; cells],
    };
    let mut values = values.into_iter();
    let is_of_active = values.len() < cells;
    for cell in order(size) {
        if is_of_active && !grid.is_active(cell) {
            continue;
        }
        let value = values.next().unwrap_or(f32::NAN);
        let slot = index(size, cell);
        if let Some(slot) = property.values.get_mut(slot) {
            *slot = value;
        }
    }
    Ok(property)
}

/// The number of cells.
fn cells(size: [u32; 3]) -> Result<usize, String> {
    let mut sides = size.iter().map(|&side| side as usize);
    let cells = sides.try_fold(1_usize, usize::checked_mul);
    let cells = cells.filter(|cells| *cells > 0 && cells.checked_mul(CORNERS).is_some());
    cells.ok_or_else(|| {
        format!("it declares {size:?} cells; a grid has at least one, and not so many")
    })
}

/// The numbers of `COORD`.
fn coordinates([nx, ny, _]: [u32; 3]) -> usize {
    (nx as usize + 1)
        .saturating_mul(ny as usize + 1)
        .saturating_mul(PILLAR)
}

/// All cells in the files' order, with the third index as this crate has it, upwards.
fn order([nx, ny, nz]: [u32; 3]) -> impl Iterator<Item = [u32; 3]> {
    let layers = (0..nz).rev();
    layers.flat_map(move |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])))
}

/// The index of a cell in this crate's order.
fn index([_, ny, nz]: [u32; 3], [i, j, k]: [u32; 3]) -> usize {
    (i as usize * ny as usize + j as usize) * nz as usize + k as usize
}

/// The axes of a grid on the map.
struct Axes {
    origin: DVec2,
    x: DVec2,
    y: DVec2,
}

impl Axes {
    const MAP: Self = Self {
        origin: DVec2::ZERO,
        x: DVec2::X,
        y: DVec2::Y,
    };

    /// Axes through a point on y, the origin, and a point on x, in units of so many metres east and north; the map's own where those are one point.
    fn of([y1, y2, o1, o2, x1, x2]: [f64; 6], metres: DVec2) -> Self {
        let origin = DVec2::new(o1, o2) * metres;
        let x = (DVec2::new(x1, x2) * metres - origin).try_normalize();
        let y = (DVec2::new(y1, y2) * metres - origin).try_normalize();
        match x.zip(y) {
            Some((x, y)) => Self { origin, x, y },
            None => Self::MAP,
        }
    }

    fn place(&self, x: f64, y: f64) -> DVec2 {
        self.origin + self.x * x + self.y * y
    }
}

impl Parts {
    fn note(&mut self, note: String) {
        if self.notes.len() < MOST_NOTES && !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// The words of `MAPUNITS`.
    fn take_map_unit<'a>(&mut self, words: impl IntoIterator<Item = &'a str>) {
        self.map_unit = self.unit("axes on the map", words);
    }

    /// The words of `GRIDUNIT`: a unit, and `MAP` where places are on the map.
    fn take_grid_unit<'a>(&mut self, words: impl IntoIterator<Item = &'a str>) {
        let (map, unit): (Vec<_>, Vec<_>) = (words.into_iter().take(UNIT_WORDS))
            .partition(|word| word.trim().eq_ignore_ascii_case("MAP"));
        self.is_on_map = !map.is_empty();
        self.grid_unit = self.unit("cells", unit);
    }

    /// The first unit among words.
    fn unit<'a>(
        &mut self,
        what: &str,
        words: impl IntoIterator<Item = &'a str>,
    ) -> Option<LengthUnit> {
        let mut said = SaidUnits::default();
        let mut words = words.into_iter().take(UNIT_WORDS);
        let unit = words.find_map(|word| said.length(what, word));
        for note in said.notes {
            self.note(note);
        }
        unit
    }

    fn grid(self, options: &ReadOptions) -> Result<EclipseGrid, String> {
        let size = self
            .size
            .ok_or("nothing in it says how many cells there are (SPECGRID, GRIDHEAD)")?;
        let cells = cells(size)?;
        for (what, found, expected) in [
            ("COORD", self.coord.len(), coordinates(size)),
            ("ZCORN", self.zcorn.len(), cells * CORNERS),
            (
                "ACTNUM",
                self.active.as_ref().map_or(cells, Vec::len),
                cells,
            ),
        ] {
            if found != expected {
                return Err(format!(
                    "{what} has {found} values, and should have {expected} for {size:?} cells"
                ));
            }
        }
        let mut frame = self.frame(options)?;
        let axes = self.axes(&mut frame, options);
        let positive = options.z_positive.unwrap_or(ZPositive::Down);
        let height = |z: f32| positive.up(f64::from(z)) * frame.height;
        let [nx, ny, nz] = size.map(|side| side as usize);
        let point = |numbers: [f32; 3]| {
            let [x, y, z] = numbers;
            let [x, y] = [x, y].map(f64::from);
            let place = axes.place(x * frame.plan.x, y * frame.plan.y);
            DVec3::new(place.x, height(z), -place.y)
        };
        let lines = self.coord.as_chunks::<3>().0.as_chunks::<2>().0;
        let columns = (0..=nx).flat_map(|i| (0..=ny).map(move |j| j * (nx + 1) + i));
        let pillars = columns.map(|at| {
            let [top, bottom] = lines.get(at).copied().unwrap_or_default();
            Pillar {
                bottom: point(bottom),
                top: point(top),
            }
        });
        let pillars = pillars.collect();
        let mut corners = vec![[f32::NAN; CORNERS]; cells];
        let mut active = vec![true; cells];
        for (number, cell) in order(size).enumerate() {
            let slot = index(size, cell);
            let [i, j, k] = cell.map(|at| at as usize);
            // From the top, as the file counts.
            let layer = nz - 1 - k;
            let depths = std::array::from_fn(|corner| {
                let (east, north, is_top) = (corner & 1, corner >> 1 & 1, corner >> 2 == 1);
                let row = 2 * layer + usize::from(!is_top);
                let at = (2 * i + east) + 2 * nx * ((2 * j + north) + 2 * ny * row);
                let depth = self.zcorn.get(at).copied().unwrap_or(f32::NAN);
                height(depth) as f32
            });
            if let Some(slot) = corners.get_mut(slot) {
                *slot = depths;
            }
            let is_on = self.active.as_ref().and_then(|active| active.get(number));
            if let Some(slot) = active.get_mut(slot) {
                *slot = is_on.copied().unwrap_or(true);
            }
        }
        let mut notes = self.notes;
        notes.extend(frame.notes);
        Ok(EclipseGrid {
            grid: CornerPointGrid::new(size, pillars, corners, active),
            notes,
        })
    }

    /// Where the grid's own axes lie. Their unit is that of the map, of which a file may say nothing although it names that of its cells.
    fn axes(&self, frame: &mut Frame, options: &ReadOptions) -> Axes {
        let Some(axes) = self.map_axes.filter(|_| !self.is_on_map) else {
            return Axes::MAP;
        };
        let named = options.units.plan.map(|_| frame.plan);
        let said = self.map_unit.map(|unit| DVec2::splat(unit.metres()));
        let unit = named.or(said);
        let axes = Axes::of(axes, unit.unwrap_or(DVec2::ONE));
        if unit.is_none() && axes.origin != DVec2::ZERO {
            frame.notes.push(
                "it names no unit of its axes on the map (MAPUNITS): taken as metres (--units)"
                    .to_owned(),
            );
        }
        axes
    }

    fn frame(&self, options: &ReadOptions) -> Result<Frame, String> {
        let lines = self.coord.as_chunks::<3>().0;
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [low, high] = lines.iter().fold(empty, |[low, high], &[x, y, z]| {
            let point = DVec3::new(x.into(), y.into(), z.into());
            [low.min(point), high.max(point)]
        });
        let extent = Extent {
            low: low.truncate(),
            high: high.truncate(),
            relief: high.z - low.z,
        };
        Frame::of(
            &extent,
            &Known {
                named: options.units,
                said: Units {
                    plan: self.grid_unit.map(PlanUnit::Length),
                    height: self.grid_unit,
                },
                looks_like_degrees: false,
                latitude: options.latitude,
            },
        )
    }
}

/// What is said of a property that is not there.
fn no_property(wanted: Option<&str>, known: &[String]) -> String {
    let known: Vec<_> = known.iter().map(|known| name(known)).collect();
    let known = match known.is_empty() {
        true => "it has none with a value for each cell".to_owned(),
        false => format!("it has {}", known.join(", ")),
    };
    match wanted {
        Some(wanted) => format!("there is no property `{}`: {known}", name(wanted)),
        None => format!("{known}; name one with --property"),
    }
}
