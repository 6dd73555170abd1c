//! Esri ASCII rasters: `key value` lines in any order, then the values, north row first.

use glam::DVec2;

use super::frame::RawRaster;
use super::text::{Tokens, decode, parse_number, whole_number};
use crate::units::Units;
use antumbra_files::MemoryBudget;
use antumbra_files::words::name;
use antumbra_scene::Raster;

pub(super) fn read(bytes: &[u8], memory: &mut MemoryBudget) -> Result<RawRaster, String> {
    let text = decode(bytes);
    let header = header(&text)?;
    let rest = header.rest;
    let columns = header.count("ncols")?;
    let rows = header.count("nrows")?;
    super::text::node_count(columns, rows, rest.len() / 2 + 1)?;
    super::take_posts(memory, columns, rows, size_of::<f64>() as u64)?;
    let size = header.get("cellsize");
    let step = DVec2::new(
        header.get("dx").or(size).ok_or("no line `cellsize`")?,
        header.get("dy").or(size).ok_or("no line `cellsize`")?,
    );
    let low = |corner: &str, centre: &str, step: f64| {
        let middle = header.get(corner).map(|corner| corner + step / 2.0);
        let missing = || format!("neither a line `{corner}` nor one `{centre}`");
        header.get(centre).or(middle).ok_or_else(missing)
    };
    let south_west = DVec2::new(
        low("xllcorner", "xllcenter", step.x)?,
        low("yllcorner", "yllcenter", step.y)?,
    );
    // The default of the format's specification.
    let nodata = header.get("nodata_value").unwrap_or(-9999.0) as f32;
    // Compared as f32, since some writers give the header's number fewer digits than the values.
    let values = Tokens::new(rest)
        .grid(columns, rows, rest.len(), |value| value as f32 == nodata)
        .map_err(|problem| format!("after the header of {} lines: {problem}", header.lines))?;
    Ok(RawRaster {
        raster: Raster {
            columns,
            rows,
            origin: south_west + DVec2::new(0.0, step.y * f64::from(rows - 1)),
            step_u: DVec2::new(step.x, 0.0),
            step_v: DVec2::new(0.0, -step.y),
            elevation: values.into_iter().map(|z| z as f32).collect(),
        },
        // The format has no word for units.
        said: Units::default(),
        is_placed: true,
        notes: Vec::new(),
    })
}

struct Header<'a> {
    keys: Vec<(&'a str, f64)>,
    lines: usize,
    /// The text after the header.
    rest: &'a str,
}

impl Header<'_> {
    fn get(&self, key: &str) -> Option<f64> {
        let found = self.keys.iter().find(|(k, _)| k.eq_ignore_ascii_case(key));
        found.map(|(_, value)| *value)
    }

    fn count(&self, key: &str) -> Result<u32, String> {
        let value = self
            .get(key)
            .ok_or_else(|| format!("there is no line `{key}`"))?;
        whole_number(value).ok_or_else(|| format!("{key} is {value}, no count"))
    }
}

/// The leading lines that begin with a key, and the text after them.
fn header(text: &str) -> Result<Header<'_>, String> {
    let mut header = Header {
        keys: Vec::new(),
        lines: 0,
        rest: text,
    };
    // `nan` and `inf` are values, not keys.
    let is_key = |word: &str| parse_number(word).is_none();
    while header.lines < 16 {
        let (line, after) = header.rest.split_once('\n').unwrap_or((header.rest, ""));
        let mut words = line.split_whitespace();
        let Some(key) = words.next().filter(|key| is_key(key)) else {
            break;
        };
        header.lines += 1;
        let value = words.next().unwrap_or_default();
        let parsed = parse_number(value).ok_or_else(|| {
            format!(
                "line {}: {} is `{}`, no number",
                header.lines,
                name(key),
                name(value)
            )
        })?;
        header.keys.push((key, parsed));
        header.rest = after;
    }
    Ok(header)
}
