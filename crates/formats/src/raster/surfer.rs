//! Golden Software's Surfer grids: ASCII (`DSAA`), Surfer 6 binary (`DSBB`) and Surfer 7 binary (`DSRB`), after the descriptions in Surfer's own
//! manual. All have their rows from south to north, nodes from west to east. None names its units.

use glam::DVec2;

use super::frame::RawRaster;
use super::text::{Tokens, decode, node_count};
use crate::units::Units;
use antumbra_files::MemoryBudget;
use antumbra_scene::Raster;

/// Values from here on are blank.
const BLANK: f64 = 1.701_41e38;

/// The tags of Surfer 7's sections, as little-endian numbers.
const HEADER: u32 = u32::from_le_bytes(*b"DSRB");
const GRID: u32 = u32::from_le_bytes(*b"GRID");
const DATA: u32 = u32::from_le_bytes(*b"DATA");

pub(super) fn read(bytes: &[u8], memory: &mut MemoryBudget) -> Result<RawRaster, String> {
    let raster = match bytes.first_chunk::<4>() {
        Some(b"DSAA") => ascii(bytes, memory),
        Some(b"DSBB") => binary_6(bytes, memory),
        Some(b"DSRB") => binary_7(bytes, memory),
        _ => Err("it begins with none of DSAA, DSBB and DSRB; if it is a CPS-3 grid, give it to `antumbra prepare` as .cps3".to_owned()),
    }?;
    Ok(RawRaster {
        raster,
        said: Units::default(),
        is_placed: true,
        notes: Vec::new(),
    })
}

/// The place of a grid: the positions of its first and last nodes.
struct Ends {
    columns: u32,
    rows: u32,
    low: DVec2,
    high: DVec2,
}

impl Ends {
    fn raster(self, elevation: Vec<f32>) -> Raster {
        let steps = DVec2::new(f64::from(self.columns - 1), f64::from(self.rows - 1));
        let step = (self.high - self.low) / steps;
        Raster {
            columns: self.columns,
            rows: self.rows,
            origin: self.low,
            step_u: DVec2::new(step.x, 0.0),
            step_v: DVec2::new(0.0, step.y),
            elevation,
        }
    }
}

fn known(value: f64, blank: f64) -> f32 {
    match value >= blank || !value.is_finite() {
        true => f32::NAN,
        false => value as f32,
    }
}

fn ascii(bytes: &[u8], memory: &mut MemoryBudget) -> Result<Raster, String> {
    let text = decode(bytes);
    let mut words = Tokens::new(&text);
    words.next_token();
    let (columns, rows) = (words.count("the columns")?, words.count("the rows")?);
    node_count(columns, rows, text.len() / 2 + 1)?;
    super::take_posts(memory, columns, rows, size_of::<f64>() as u64)?;
    let mut range = |what| Ok::<_, String>([words.number(what)?, words.number(what)?]);
    let [west, east] = range("an end of x")?;
    let [south, north] = range("an end of y")?;
    range("an end of z")?;
    let values = words.grid(columns, rows, text.len(), |value| value >= BLANK)?;
    let ends = Ends {
        columns,
        rows,
        low: DVec2::new(west, south),
        high: DVec2::new(east, north),
    };
    Ok(ends.raster(values.into_iter().map(|value| value as f32).collect()))
}

/// Takes little-endian numbers from bytes.
struct Numbers<'a>(&'a [u8]);

impl<'a> Numbers<'a> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let (first, rest) = self
            .0
            .split_first_chunk::<N>()
            .ok_or("it ends within its header")?;
        self.0 = rest;
        Ok(*first)
    }

    fn float(&mut self) -> Result<f64, String> {
        Ok(f64::from_le_bytes(self.take()?))
    }

    fn count(&mut self) -> Result<u32, String> {
        let count = i32::from_le_bytes(self.take()?);
        u32::try_from(count).map_err(|_| format!("it declares {count} nodes along a side"))
    }

    fn bytes(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (first, rest) = self
            .0
            .split_at_checked(count)
            .ok_or_else(|| format!("{count} bytes should follow, but {} do", self.0.len()))?;
        self.0 = rest;
        Ok(first)
    }
}

fn binary_6(bytes: &[u8], memory: &mut MemoryBudget) -> Result<Raster, String> {
    let mut file = Numbers(bytes);
    file.take::<4>()?;
    let mut side = || Ok::<_, String>(u32::from(u16::from_le_bytes(file.take()?)));
    let (columns, rows) = (side()?, side()?);
    let [west, east, south, north, _, _] = {
        let mut ends = [0.0; 6];
        for end in &mut ends {
            *end = file.float()?;
        }
        ends
    };
    let nodes = node_count(columns, rows, file.0.len() / size_of::<f32>())?;
    super::take_posts(memory, columns, rows, 0)?;
    let values = file.bytes(nodes * size_of::<f32>())?.as_chunks::<4>().0;
    let values = values.iter().map(|value| f32::from_le_bytes(*value));
    let ends = Ends {
        columns,
        rows,
        low: DVec2::new(west, south),
        high: DVec2::new(east, north),
    };
    Ok(ends.raster(values.map(|value| known(value.into(), BLANK)).collect()))
}

fn binary_7(bytes: &[u8], memory: &mut MemoryBudget) -> Result<Raster, String> {
    let mut file = Numbers(bytes);
    let mut grid = None;
    loop {
        let tag = u32::from_le_bytes(file.take()?);
        let size = u32::from_le_bytes(file.take()?) as usize;
        // The last section may be given a size that its writer did not know.
        let section = match (tag, grid.is_some()) {
            (DATA, true) => file.bytes(size.min(file.0.len()))?,
            _ => file.bytes(size)?,
        };
        match (tag, grid.take()) {
            (HEADER, _) => {}
            (GRID, _) => grid = Some(Grid7::of(Numbers(section))?),
            (DATA, Some(found)) => return found.raster(section, memory),
            (DATA, None) => return Err("its values precede its size".to_owned()),
            // Fault traces and what else may be there.
            (_, found) => grid = found,
        }
    }
}

/// The section `GRID` of Surfer 7.
struct Grid7 {
    ends: Ends,
    blank: f64,
}

impl Grid7 {
    fn of(mut section: Numbers<'_>) -> Result<Self, String> {
        let (rows, columns) = (section.count()?, section.count()?);
        let mut numbers = [0.0; 8];
        for number in &mut numbers {
            *number = section.float()?;
        }
        let [west, south, step_x, step_y, _, _, degrees, blank] = numbers;
        if degrees != 0.0 {
            return Err(format!(
                "it is rotated by {degrees} degrees, which Surfer never writes"
            ));
        }
        let low = DVec2::new(west, south);
        let steps = DVec2::new(
            f64::from(columns.saturating_sub(1)),
            f64::from(rows.saturating_sub(1)),
        );
        Ok(Self {
            ends: Ends {
                columns,
                rows,
                low,
                high: low + steps * DVec2::new(step_x, step_y),
            },
            blank: if blank > 0.0 { blank } else { BLANK },
        })
    }

    fn raster(self, values: &[u8], memory: &mut MemoryBudget) -> Result<Raster, String> {
        let Ends { columns, rows, .. } = self.ends;
        let values = values.as_chunks::<8>().0;
        let nodes = node_count(columns, rows, values.len())?;
        super::take_posts(memory, columns, rows, 0)?;
        let values = values.iter().take(nodes);
        let values = values.map(|value| known(f64::from_le_bytes(*value), self.blank));
        let elevation = values.collect();
        Ok(self.ends.raster(elevation))
    }
}
