//! Picks: a table of points on horizons, as set by an interpreter, separated by commas, semicolons or tabs.

use std::collections::HashMap;

use antumbra_files::words::name;
use antumbra_formats::raster::text::{decode, parse_number};
use glam::DVec3;

use super::budget::ReadBudget;
use super::delaunay::PointSet;
use super::options::{ReadOptions, ZPositive};
use crate::assemble;

const EAST: [&str; 6] = ["x", "easting", "east", "x_utme", "utm_x", "x_coord"];
const NORTH: [&str; 6] = ["y", "northing", "north", "y_utmn", "utm_y", "y_coord"];
const ELEVATION: [&str; 3] = ["z", "elevation", "height"];
const DEPTH: [&str; 6] = ["depth", "tvd", "tvdss", "tvd_ss", "z_tvdss", "z_depth"];
const SURFACE: [&str; 6] = [
    "surface",
    "horizon",
    "formation",
    "feature_name",
    "name",
    "val",
];

/// The picks of each surface that is named, in the file's order and units.
pub(super) fn read(
    bytes: &[u8],
    stem: &str,
    options: &ReadOptions,
    budget: &mut ReadBudget,
) -> Result<Vec<PointSet>, String> {
    let text = decode(bytes);
    let mut table = csv::ReaderBuilder::new()
        .delimiter(separator(&text))
        .trim(csv::Trim::All)
        .flexible(true)
        .from_reader(text.as_bytes());
    let headers = table.headers().map_err(|error| error.to_string())?;
    let columns = Columns::of(headers, options)?;
    let mut picks: Vec<PointSet> = Vec::new();
    let mut named: HashMap<String, usize> = HashMap::new();
    let mut row = csv::StringRecord::new();
    while table
        .read_record(&mut row)
        .map_err(|error| error.to_string())?
    {
        let Some(Pick { surface, point }) = columns.pick(&row)? else {
            continue;
        };
        budget.vertex(|| format!("the picks up to the one of '{}'", name(&surface)))?;
        let known = named.len();
        let at = *named.entry(surface).or_insert_with_key(|name| {
            let name = if name.is_empty() { stem } else { name.as_str() };
            picks.push(PointSet {
                name: name.to_owned(),
                points: Vec::new(),
            });
            picks.len() - 1
        });
        if named.len() > known {
            budget.surfaces(1, 0, || format!("its {} surfaces", named.len()))?;
        }
        if let Some(set) = picks.get_mut(at) {
            set.points.push(point);
        }
    }
    if picks.is_empty() {
        return Err("it has no pick; there is nothing to show".into());
    }
    Ok(picks)
}

/// The separator that occurs most often in the first line.
fn separator(text: &str) -> u8 {
    let first = text.lines().next().unwrap_or_default();
    let count = |of: &u8| first.bytes().filter(|byte| byte == of).count();
    // Of equal counts the last wins: the comma.
    b"\t;,".iter().copied().max_by_key(count).unwrap_or(b',')
}

/// A point on a surface.
struct Pick {
    surface: String,
    point: DVec3,
}

struct Columns {
    east: usize,
    north: usize,
    third: usize,
    positive: ZPositive,
    surface: Vec<usize>,
}

impl Columns {
    fn of(headers: &csv::StringRecord, options: &ReadOptions) -> Result<Self, String> {
        let find = |name: &str| {
            let mut names = headers.iter();
            names.position(|header| header.eq_ignore_ascii_case(name))
        };
        let any = |names: &[&str]| names.iter().find_map(|name| find(name));
        let missing = |names: &[&str]| {
            format!(
                "no column of the first line is called {}",
                names.join(" or ")
            )
        };
        let (elevation, depth) = (any(&ELEVATION), any(&DEPTH));
        let custom = match (elevation, depth) {
            (None, Some(_)) => ZPositive::Down,
            _ => ZPositive::Up,
        };
        let surface = match &options.surface_column {
            Some(name) => vec![find(name).ok_or_else(|| missing(&[name.as_str()]))?],
            None => SURFACE.iter().filter_map(|name| find(name)).collect(),
        };
        Ok(Self {
            east: any(&EAST).ok_or_else(|| missing(&EAST))?,
            north: any(&NORTH).ok_or_else(|| missing(&NORTH))?,
            third: elevation
                .or(depth)
                .ok_or_else(|| missing(&[&ELEVATION[..], &DEPTH].concat()))?,
            positive: options.z_positive.unwrap_or(custom),
            surface,
        })
    }

    /// The pick of a row; `None` for a row without a surface's name, since a table may have rows of other things.
    fn pick(&self, row: &csv::StringRecord) -> Result<Option<Pick>, String> {
        let names = self.surface.iter().map(|&at| row.get(at).unwrap_or(""));
        let names: Vec<_> = names.collect();
        if row.iter().all(str::is_empty) || names.iter().any(|name| name.is_empty()) {
            return Ok(None);
        }
        let line = row.position().map_or(0, csv::Position::line);
        let coordinate = |at: usize, what: &str| {
            let word = row.get(at).unwrap_or("");
            parse_number(word).ok_or_else(|| format!("line {line}: {what} is `{word}`, no number"))
        };
        let (x, y) = (coordinate(self.east, "x")?, coordinate(self.north, "y")?);
        let z = coordinate(self.third, "z")?;
        let point = DVec3::new(x, self.positive.up(z), -y);
        if !assemble::is_place(point) {
            return Err(format!("line {line}: ({x}, {y}, {z}) is no place on Earth"));
        }
        Ok(Some(Pick {
            surface: names.join(" "),
            point,
        }))
    }
}
