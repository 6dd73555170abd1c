//! Lines of numbers without a title: `x y z`, or `inline crossline x y z` (IJXYZ, as seismic interpretation systems write picked horizons).
//!
//! Lines that begin with `@`, `#`, `!` or `--` are comments. Numbers are apart by spaces, tabs, commas or semicolons.

use antumbra_files::words::name;
use antumbra_formats::raster::text::{decode, parse_number};
use antumbra_scene::Raster;
use glam::{DVec2, DVec3};

use super::budget::ReadBudget;
use super::options::ZPositive;
use crate::assemble;
use crate::survey::{GridFit, LineNumbers};

/// Heights and depths from here on are no values.
const UNDEFINED: f64 = 999_990.0;
/// The most positions of a grid for each point of a file.
const SPARSE: u64 = 64;
/// Bytes of a point while it is read, and of a position of the grid.
const POINT: u64 = 40;

/// What the lines of a file have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Columns {
    /// x, y, z, and perhaps more.
    Points,
    /// Inline, crossline, x, y, z.
    Lines,
}

/// What the lines of a file have, by the first one with content; `None` if that is not of numbers.
pub(super) fn columns(bytes: &[u8]) -> Option<Columns> {
    // Any title is within the first lines, and any line of numbers is short.
    let begin = decode(bytes.get(..64 << 10).unwrap_or(bytes));
    let line = begin.lines().find(|line| !is_comment(line))?;
    let numbers: Vec<f64> = words(line).map(parse_number).collect::<Option<_>>()?;
    match numbers.as_slice() {
        [inline, crossline, _, _, _] if inline.fract() == 0.0 && crossline.fract() == 0.0 => {
            Some(Columns::Lines)
        }
        [_, _, _, ..] => Some(Columns::Points),
        _ => None,
    }
}

/// Reads points.
pub(super) fn points(
    bytes: &[u8],
    positive: ZPositive,
    budget: &mut ReadBudget,
) -> Result<Vec<DVec3>, String> {
    let mut points = Vec::new();
    each::<3>(bytes, |line, [x, y, z]| {
        let point = DVec3::new(x, positive.up(z), -y);
        if z.abs() >= UNDEFINED {
            return Ok(());
        }
        if !assemble::is_place(point) {
            return Err(format!("line {line}: ({x}, {y}, {z}) is no place on Earth"));
        }
        budget.vertex(|| format!("the points up to line {line}"))?;
        points.push(point);
        Ok(())
    })?;
    match points.is_empty() {
        true => Err("it has no point; there is nothing to show".into()),
        false => Ok(points),
    }
}

/// Reads a horizon on the grid of its lines.
pub(super) fn grid(
    bytes: &[u8],
    positive: ZPositive,
    budget: &mut ReadBudget,
) -> Result<Raster, String> {
    let mut nodes: Vec<([i32; 2], f32)> = Vec::new();
    let mut fit = GridFit::default();
    each::<5>(bytes, |line, [inline, crossline, x, y, z]| {
        if z.abs() >= UNDEFINED {
            return Ok(());
        }
        budget.take(POINT, || format!("the points up to line {line}"))?;
        // Some writers give lines with decimals.
        let numbers = [inline, crossline].map(|number| number.round() as i32);
        fit.add(inline.round(), crossline.round(), DVec2::new(x, y));
        nodes.push((numbers, positive.up(z) as f32));
        Ok(())
    })?;
    let lines = |axis: usize| {
        let all = nodes.iter();
        LineNumbers::of(all.map(move |(numbers, _)| numbers[axis]))
    };
    let [Some(inlines), Some(crosslines)] = [lines(0), lines(1)] else {
        return Err("it has no point; there is nothing to show".into());
    };
    let plan = fit.grid();
    let plan = plan.ok_or("its positions span no plan; give lines of x, y and z")?;
    let cells = inlines.count.saturating_mul(crosslines.count);
    if cells > (nodes.len() as u64).saturating_mul(SPARSE) {
        return Err(format!(
            "its {} points lie on a grid of {} inlines and {} crosslines, almost all of it empty; give lines of x, y and z",
            nodes.len(),
            inlines.count,
            crosslines.count
        ));
    }
    budget.take(cells.saturating_mul(POINT), || {
        format!("its {} x {} nodes", inlines.count, crosslines.count)
    })?;
    let mut elevation = vec![f32::NAN; cells as usize];
    for &([inline, crossline], height) in &nodes {
        let place = inlines.index(inline).zip(crosslines.index(crossline));
        let slot = place.and_then(|(row, column)| {
            elevation.get_mut((row * crosslines.count + column) as usize)
        });
        if let Some(slot) = slot {
            *slot = height;
        }
    }
    let count = |lines: LineNumbers| u32::try_from(lines.count).unwrap_or(u32::MAX);
    Ok(Raster {
        columns: count(crosslines),
        rows: count(inlines),
        origin: plan.place(inlines.first.into(), crosslines.first.into()),
        step_u: plan.crossline * f64::from(crosslines.step),
        step_v: plan.inline * f64::from(inlines.step),
        elevation,
    })
}

fn is_comment(line: &str) -> bool {
    let line = line.trim_start();
    line.is_empty() || line.starts_with(['@', '#', '!']) || line.starts_with("--")
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    let words = line.split(|c: char| c.is_whitespace() || c == ',' || c == ';');
    words.filter(|word| !word.is_empty())
}

/// Calls `found` with the number and the first `N` numbers of each line that is no comment. `EOB` ends the lines, as some writers have it.
fn each<const N: usize>(
    bytes: &[u8],
    mut found: impl FnMut(usize, [f64; N]) -> Result<(), String>,
) -> Result<(), String> {
    let text = decode(bytes);
    for (number, line) in (1..).zip(text.lines()) {
        if is_comment(line) {
            continue;
        }
        let mut words = words(line);
        let mut numbers = [0.0; N];
        for (at, value) in numbers.iter_mut().enumerate() {
            let word = words.next().unwrap_or_default();
            if at == 0 && word == "EOB" {
                return Ok(());
            }
            *value = parse_number(word)
                .ok_or_else(|| format!("line {number}: `{}` is no number", name(word)))?;
        }
        found(number, numbers)?;
    }
    Ok(())
}
