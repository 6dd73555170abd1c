//! ZMAP+ grids (Landmark's `ZMAP PLUS`, "ZYCOR grid"): comments after `!`, a header between two lines that begin with `@`, then the values.
//!
//! The header's lines have fields separated by commas: the file's name, `GRID` and the values of a line; a field's width, the value for "no value"
//! or its text, decimals, first column; rows, columns and the box. Values go from north to south, one column after the other from west to east, and
//! every column begins on a new line.

use antumbra_formats::raster::text::{decode, parse_number, whole_number};
use antumbra_scene::Raster;
use glam::DVec2;

use super::budget::ReadBudget;
use super::column_grid::ColumnGrid;
use super::options::ZPositive;

pub(super) fn read(
    bytes: &[u8],
    positive: ZPositive,
    budget: &mut ReadBudget,
) -> Result<Raster, String> {
    let text = decode(bytes);
    let mut rest = text.as_ref();
    let mut header = Vec::new();
    // Lines up to the one with `@` alone.
    loop {
        let (line, after) = rest.split_once('\n').unwrap_or((rest, ""));
        if rest.is_empty() {
            return Err("its header does not end with a line `@`".into());
        }
        rest = after;
        let line = line.trim();
        if line.is_empty() || line.starts_with('!') {
            continue;
        }
        if let Some(named) = line.strip_prefix('@')
            && header.is_empty()
        {
            let mut fields = named.split(',').map(str::trim);
            if !fields.any(|field| field.eq_ignore_ascii_case("GRID")) {
                return Err(
                    "its header line with `@` does not say GRID; only grids are read".into(),
                );
            }
        } else if line.starts_with('@') {
            break;
        }
        header.push(line);
        if header.len() > 16 {
            return Err("its header does not end with a line `@`".into());
        }
    }
    let [_, layout, area, ..] = header.as_slice() else {
        return Err("its header has fewer than three lines".into());
    };
    let field = |line: &str, at: usize| {
        line.split(',')
            .nth(at)
            .map(str::trim)
            .and_then(parse_number)
    };
    // The value, or in the next field its text.
    let nothing = field(layout, 1).or_else(|| field(layout, 2));
    let number = |at: usize, what: &str| {
        field(area, at).ok_or_else(|| format!("its header has no {what} in the line `{area}`"))
    };
    let count = |at: usize, what: &str| {
        let value = number(at, what)?;
        whole_number(value).ok_or_else(|| format!("its header has {value} as {what}"))
    };
    let (rows, columns) = (count(0, "number of rows")?, count(1, "number of columns")?);
    let grid = ColumnGrid {
        columns,
        rows,
        low: DVec2::new(number(2, "least x")?, number(4, "least y")?),
        high: DVec2::new(number(3, "greatest x")?, number(5, "greatest y")?),
    };
    // Some writers put a remark between the header and the values.
    while let Some((line, after)) = rest.split_once('\n')
        && (line.split_whitespace().next()).is_none_or(|word| parse_number(word).is_none())
    {
        rest = after;
    }
    grid.read(rest, positive, budget, |value| {
        nothing.is_some_and(|nothing| nothing as f32 == value as f32)
    })
}
