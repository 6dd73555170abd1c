//! NumPy arrays in a zip archive (`numpy.savez`): elevations and their position.
//!
//! The array with two dimensions is the elevation, its first row the northernmost. Its position is given by other
//! arrays with customary names: `dx` and `dy`, the cells' size, with `xmin` and `ymin` (or `ymax`), or `longitude`
//! (`x`) and `latitude` (`y`), one number per column and row. Positions by longitude and latitude are degrees. Without
//! any of these a cell is a metre wide.

use std::io::{Cursor, Read};

use glam::DVec2;
use zip::ZipArchive;

use super::frame::RawRaster;
use super::text::node_count;
use crate::units::{PlanUnit, Units};
use antumbra_files::words::name;
use antumbra_files::{MemoryBudget, OverBudget};
use antumbra_scene::Raster;

/// The greatest number of bytes of a decoded array, and the greatest ratio to the compressed bytes.
const MAX_BYTES: u64 = 1 << 30;
const MAX_PACKED: u64 = 1100;
/// The greatest number of numbers of an array.
const MAX_NUMBERS: usize = 1 << 27;
/// The greatest number of arrays that are looked at, and of dimensions of an array: those of NumPy.
const MAX_ARRAYS: usize = 64;
const MAX_DIMENSIONS: usize = 64;

/// An array.
struct Array {
    shape: Vec<usize>,
    values: Vec<f64>,
}

pub(super) fn read(bytes: &[u8], memory: &mut MemoryBudget) -> Result<RawRaster, String> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let mut arrays = Vec::new();
    // Entries that share bytes would each be decoded.
    let mut packed = 0_u64;
    for index in 0..archive.len().min(MAX_ARRAYS) {
        let mut entry = archive.by_index(index).map_err(|error| error.to_string())?;
        packed = packed.saturating_add(entry.compressed_size());
        if packed > bytes.len() as u64 {
            return Err("its entries overlap; save it again".to_owned());
        }
        let full = entry.name().map_err(|error| error.to_string())?;
        let Some(full) = full.strip_suffix(".npy").map(str::to_owned) else {
            continue;
        };
        let name = name(&full);
        let most = entry
            .compressed_size()
            .saturating_mul(MAX_PACKED)
            .min(MAX_BYTES);
        let size = entry.size();
        if size > most {
            return Err(format!(
                "array `{name}` is said to take {size} bytes, and {most} are the most that may be there"
            ));
        }
        let part = || format!("its array `{name}`");
        let over = |over: OverBudget| over.to_string();
        // Unpacked, which is given back, and as numbers of eight bytes.
        memory.allow(size, part).map_err(over)?;
        let mut contents = Vec::new();
        let mut limited = entry.by_ref().take(size);
        (limited.read_to_end(&mut contents)).map_err(|error| format!("array `{name}`: {error}"))?;
        let parsed = parse(&contents).map_err(|problem| format!("array `{name}`: {problem}"))?;
        let numbers = (parsed.data.len() / parsed.kind.bytes) as u64 * size_of::<f64>() as u64;
        memory
            .allow(size.saturating_add(numbers), part)
            .map_err(over)?;
        memory
            .take(numbers + full.len() as u64, part)
            .map_err(over)?;
        arrays.push((full, parsed.numbers()));
    }
    let grid = arrays.iter().find(|(_, array)| array.shape.len() == 2);
    if let Some((_, Array { shape, .. })) = grid
        && let [rows, columns] = shape.as_slice()
        && let (Ok(rows), Ok(columns)) = (u32::try_from(*rows), u32::try_from(*columns))
    {
        super::take_posts(memory, columns, rows, 0)?;
    }
    raster(&arrays)
}

/// An array's header, checked against its bytes.
struct Parsed<'a> {
    shape: Vec<usize>,
    kind: NumberType,
    data: &'a [u8],
}

impl Parsed<'_> {
    fn numbers(self) -> Array {
        let values = self.data.chunks_exact(self.kind.bytes).map(self.kind.read);
        Array {
            values: values.collect(),
            shape: self.shape,
        }
    }
}

/// Reads the header of an `.npy` array.
fn parse(bytes: &[u8]) -> Result<Parsed<'_>, String> {
    let cut = || "it is cut off".to_owned();
    let rest = bytes
        .strip_prefix(b"\x93NUMPY")
        .ok_or("it does not begin as NumPy's do")?;
    let (&[version, _], rest) = rest.split_first_chunk::<2>().ok_or_else(cut)?;
    let (length, rest) = match version {
        1 => {
            let (length, rest) = rest.split_first_chunk().ok_or_else(cut)?;
            (u32::from(u16::from_le_bytes(*length)), rest)
        }
        _ => {
            let (length, rest) = rest.split_first_chunk().ok_or_else(cut)?;
            (u32::from_le_bytes(*length), rest)
        }
    };
    let (header, data) = rest.split_at_checked(length as usize).ok_or_else(cut)?;
    let header = String::from_utf8_lossy(header);
    let field = |name: &str| {
        let after = header.split_once(&format!("'{name}':"))?.1;
        Some(after.trim_start())
    };
    let kind = field("descr").and_then(|text| text.strip_prefix('\'')?.split_once('\''));
    let kind = kind.ok_or("its header has no single type")?.0;
    if field("fortran_order").is_some_and(|text| text.starts_with("True")) {
        return Err("its columns come first; save it in C order".to_owned());
    }
    let shape = field("shape").and_then(|text| text.strip_prefix('(')?.split_once(')'));
    let shape = shape.ok_or("its header has no shape")?.0.split(',');
    let shape = shape.map(str::trim).filter(|size| !size.is_empty());
    let shape: Vec<usize> = shape
        .take(MAX_DIMENSIONS)
        .map(|size| {
            size.parse()
                .map_err(|_| format!("`{}` is no size", name(size)))
        })
        .collect::<Result<_, _>>()?;
    let count = shape
        .iter()
        .try_fold(1_usize, |all, size| all.checked_mul(*size));
    let number = number_type(kind)?;
    let size = number.bytes;
    let whole = count.and_then(|count| count.checked_mul(size));
    if whole != Some(data.len()) {
        return Err(format!(
            "{} bytes of {kind} are no array of {shape:?}",
            data.len()
        ));
    }
    if data.len() / size > MAX_NUMBERS {
        return Err(format!(
            "an array of {shape:?} has more than {MAX_NUMBERS} numbers; cut it into parts"
        ));
    }
    Ok(Parsed {
        shape,
        kind: number,
        data,
    })
}

/// A type of numbers.
struct NumberType {
    read: fn(&[u8]) -> f64,
    bytes: usize,
}

/// The type of numbers with this name.
fn number_type(kind: &str) -> Result<NumberType, String> {
    macro_rules! numbers {
        ($($little:literal $big:literal $kind:ty),*) => {
            match kind {
                $(
                    $little => Ok(NumberType { read: |bytes| <$kind>::from_le_bytes(bytes.try_into().unwrap_or_default()) as f64, bytes: size_of::<$kind>() }),
                    $big => Ok(NumberType { read: |bytes| <$kind>::from_be_bytes(bytes.try_into().unwrap_or_default()) as f64, bytes: size_of::<$kind>() }),
                )*
                _ => Err(format!("its numbers are of type `{}`; save them as int or float", name(kind))),
            }
        };
    }
    numbers!(
        "|u1" ">u1" u8, "|i1" ">i1" i8, "<u2" ">u2" u16, "<i2" ">i2" i16, "<u4" ">u4" u32, "<i4" ">i4" i32,
        "<u8" ">u8" u64, "<i8" ">i8" i64, "<f4" ">f4" f32, "<f8" ">f8" f64
    )
}

fn raster(arrays: &[(String, Array)]) -> Result<RawRaster, String> {
    let mut flat = arrays.iter().filter(|(_, array)| array.shape.len() == 2);
    let (Some((_, heights)), None) = (flat.next(), flat.next()) else {
        return Err("not one of its arrays has two dimensions, or several have".to_owned());
    };
    let size = |of: usize| u32::try_from(heights.shape[of]).map_err(|error| error.to_string());
    let (rows, columns) = (size(0)?, size(1)?);
    node_count(columns, rows, heights.values.len())?;
    let named = |names: &[&str]| {
        let mut found = arrays.iter().filter(|(name, array)| {
            names.iter().any(|known| known.eq_ignore_ascii_case(name)) && !array.values.is_empty()
        });
        found.next().map(|(_, array)| array)
    };
    let single = |name: &str| named(&[name]).filter(|array| array.values.len() == 1);
    let single = |name: &str| single(name).map(|array| array.values[0]);
    // The positions of the first and the last node along an axis.
    let ends = |names: &[&str], count: u32| {
        let mut all = arrays.iter().filter(|(name, array)| {
            names.iter().any(|known| known.eq_ignore_ascii_case(name))
                && array.values.len() == count as usize
        });
        let (name, array) = all.next()?;
        Some(Ends {
            positions: [array.values[0], array.values[count as usize - 1]],
            are_degrees: !names
                .last()
                .is_some_and(|plain| plain.eq_ignore_ascii_case(name)),
        })
    };
    let along_x = ends(&["longitude", "lon", "x"], columns);
    let along_y = ends(&["latitude", "lat", "y"], rows);
    let are_degrees = |ends: &Option<Ends>| ends.as_ref().is_some_and(|ends| ends.are_degrees);
    let is_geographic = are_degrees(&along_x) && are_degrees(&along_y);
    let is_placed = along_x.is_some() || named(&["dx"]).is_some();
    let (x, dx) = Axis {
        ends: along_x.map(|ends| ends.positions),
        step: single("dx"),
        low: single("xmin"),
        high: single("xmax"),
        nodes: columns,
        direction: Direction::Ascending,
    }
    .first_and_step();
    let (y, dy) = Axis {
        ends: along_y.map(|ends| ends.positions),
        step: single("dy"),
        low: single("ymin"),
        high: single("ymax"),
        nodes: rows,
        direction: Direction::Descending,
    }
    .first_and_step();
    Ok(RawRaster {
        raster: Raster {
            columns,
            rows,
            origin: DVec2::new(x, y),
            step_u: DVec2::new(dx, 0.0),
            step_v: DVec2::new(0.0, dy),
            elevation: heights.values.iter().map(|&height| height as f32).collect(),
        },
        said: Units {
            plan: is_geographic.then_some(PlanUnit::DEGREES),
            height: None,
        },
        is_placed,
        notes: Vec::new(),
    })
}

/// The positions of the first and the last node along an axis, as an array has them.
struct Ends {
    positions: [f64; 2],
    /// Whether the array is called a longitude or a latitude.
    are_degrees: bool,
}

/// What a file specifies about an axis.
struct Axis {
    /// The positions of the first and the last node.
    ends: Option<[f64; 2]>,
    step: Option<f64>,
    low: Option<f64>,
    high: Option<f64>,
    nodes: u32,
    direction: Direction,
}

/// The direction of positions along an axis, where only its ends are specified.
#[derive(Clone, Copy)]
enum Direction {
    Ascending,
    Descending,
}

impl Axis {
    /// The position of the first node, and the step to the next.
    fn first_and_step(&self) -> (f64, f64) {
        let steps = f64::from(self.nodes - 1);
        if let Some([first, last]) = self.ends {
            return (first, (last - first) / steps);
        }
        let step = self.step.unwrap_or(1.0);
        let low = self
            .low
            .or(self.high.map(|high| high - step * steps))
            .unwrap_or(0.0);
        // The positions are those of cell centres, where files give those of corners.
        match self.direction {
            Direction::Ascending => (low, step),
            Direction::Descending => (low + step * steps, -step),
        }
    }
}
