//! Irap binary surfaces: Fortran records of big-endian numbers, each with its length before and after.
//!
//! The header has three records (-996, rows, box, steps; columns, rotation and its centre; seven integers). The
//! values follow, columns fastest, in any number of records.

use antumbra_formats::raster::text::node_count;
use antumbra_scene::Raster;
use glam::DVec2;

use super::budget::ReadBudget;
use super::byte_reader::ByteReader;
use super::options::ZPositive;

/// The first record's length and the format's number.
pub(super) const MAGIC: [u8; 8] = [0, 0, 0, 32, 0xff, 0xff, 0xfc, 0x1c];

/// Values from here on are undefined.
pub(super) const UNDEFINED: f64 = 9_999_900.0;

pub(super) fn read(
    bytes: &[u8],
    positive: ZPositive,
    budget: &mut ReadBudget,
) -> Result<Raster, String> {
    if !bytes.starts_with(&MAGIC) {
        return Err("it does not begin with a record of 32 bytes and -996".into());
    }
    let mut file = ByteReader::new(bytes);
    let mut box_record = ByteReader::new(record(&mut file, Some(32), "the first record")?);
    box_record.take(4, "the format's number")?;
    let rows = box_record.i32_big("rows")?;
    let [west, _, south, _, step_u, step_v] = numbers(&mut box_record)?;
    let mut turn_record = ByteReader::new(record(&mut file, Some(16), "the second record")?);
    let columns = turn_record.i32_big("columns")?;
    let [degrees, centre_x, centre_y] = numbers(&mut turn_record)?;
    record(&mut file, Some(28), "the third record")?;
    let [columns, rows] = [columns, rows].map(|side| u32::try_from(side).unwrap_or_default());
    let nodes = node_count(columns, rows, bytes.len() / 4)?;
    budget.horizon(columns, rows)?;
    let mut elevation = Vec::with_capacity(nodes);
    while !file.is_at_end() {
        let at = file.at();
        let values = record(&mut file, None, "a record of values")?.as_chunks::<4>();
        if !values.1.is_empty() || elevation.len() + values.0.len() > nodes {
            return Err(format!(
                "the record at byte {at} does not fit the {columns} x {rows} values declared"
            ));
        }
        let values = values.0.iter().map(|value| f32::from_be_bytes(*value));
        elevation.extend(values.map(|value| height(f64::from(value), positive)));
    }
    if elevation.len() != nodes {
        return Err(format!(
            "{columns} x {rows} values are declared, but the file ends after {}",
            elevation.len()
        ));
    }
    let placement = GridPlacement {
        corner: DVec2::new(west, south),
        steps: DVec2::new(step_u, step_v),
        degrees,
        centre: DVec2::new(centre_x, centre_y),
    };
    Ok(placement.raster(columns, rows, elevation))
}

/// The position of an Irap surface: its grid rotated about a point.
pub(super) struct GridPlacement {
    pub(super) corner: DVec2,
    pub(super) steps: DVec2,
    /// The rotation, counter-clockwise from east.
    pub(super) degrees: f64,
    pub(super) centre: DVec2,
}

impl GridPlacement {
    pub(super) fn raster(&self, columns: u32, rows: u32, elevation: Vec<f32>) -> Raster {
        let turn = DVec2::from_angle(self.degrees.to_radians());
        // Some writers rotate about the first node and leave the centre at zero.
        let centre = match self.centre {
            DVec2::ZERO => self.corner,
            centre => centre,
        };
        let corner = centre + turn.rotate(self.corner - centre);
        Raster {
            columns,
            rows,
            origin: corner,
            step_u: turn.rotate(DVec2::new(self.steps.x, 0.0)),
            step_v: turn.rotate(DVec2::new(0.0, self.steps.y)),
            elevation,
        }
    }
}

/// The elevation for a value; NaN for an undefined one.
pub(super) fn height(value: f64, positive: ZPositive) -> f32 {
    if value >= UNDEFINED {
        f32::NAN
    } else {
        positive.up(value) as f32
    }
}

fn numbers<const N: usize>(record: &mut ByteReader<'_>) -> Result<[f64; N], String> {
    let mut numbers = [0.0; N];
    for number in &mut numbers {
        *number = f64::from(record.f32_big("a number")?);
    }
    Ok(numbers)
}

fn record<'a>(
    file: &mut ByteReader<'a>,
    length: Option<usize>,
    what: &str,
) -> Result<&'a [u8], String> {
    let at = file.at();
    let before = file.i32_big(what)?;
    let wanted = usize::try_from(before).unwrap_or(usize::MAX);
    if length.is_some_and(|length| length != wanted) {
        return Err(format!(
            "{what} at byte {at} is {before} bytes long, and should be {}",
            length.unwrap_or_default()
        ));
    }
    let held = file.take(wanted, what)?;
    let after = file.i32_big(what)?;
    if after != before {
        return Err(format!(
            "{what} at byte {at} is {before} bytes long before its end and {after} after it"
        ));
    }
    Ok(held)
}
