//! CPS-3 grids in ASCII: lines that begin with `FS` for the value of "no value", the box, the size and the steps, then the values from north to
//! south, one column after the other from west to east.

use antumbra_formats::raster::text::{decode, parse_number, whole_number};
use antumbra_scene::Raster;
use glam::DVec2;

use super::budget::ReadBudget;
use super::column_grid::ColumnGrid;
use super::options::ZPositive;

/// The value of "no value" where none is named.
const NOTHING: f64 = 1e30;

pub(super) fn read(
    bytes: &[u8],
    positive: ZPositive,
    budget: &mut ReadBudget,
) -> Result<Raster, String> {
    let text = decode(bytes);
    let (mut nothing, mut limits, mut size) = (NOTHING, None, None);
    let mut rest = text.as_ref();
    loop {
        let (line, after) = rest.split_once('\n').unwrap_or((rest, ""));
        let mut words = line.split_whitespace();
        let key = words.next().unwrap_or_default();
        let mut numbers = words.filter_map(parse_number);
        match key.to_ascii_uppercase().as_str() {
            "FSASCI" => nothing = numbers.next_back().unwrap_or(NOTHING),
            "FSLIMI" => limits = four(numbers),
            "FSNROW" => size = two(numbers),
            // What else there may be: attributes, steps, a title, comments.
            word if word.starts_with("FS") || word.starts_with("->") || word.starts_with('!') => {}
            "" if !after.is_empty() => {}
            _ => break,
        }
        rest = after;
    }
    let [west, east, south, north] = limits.ok_or("no line FSLIMI has its four limits")?;
    let [rows, columns] = size.ok_or("no line FSNROW has its two counts")?;
    let grid = ColumnGrid {
        columns,
        rows,
        low: DVec2::new(west, south),
        high: DVec2::new(east, north),
    };
    grid.read(rest, positive, budget, |value| {
        value as f32 == nothing as f32 || value >= NOTHING
    })
}

fn four(mut numbers: impl Iterator<Item = f64>) -> Option<[f64; 4]> {
    Some([
        numbers.next()?,
        numbers.next()?,
        numbers.next()?,
        numbers.next()?,
    ])
}

fn two(numbers: impl Iterator<Item = f64>) -> Option<[u32; 2]> {
    let mut counts = numbers.filter_map(whole_number);
    Some([counts.next()?, counts.next()?])
}
