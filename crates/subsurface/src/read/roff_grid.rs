//! Corner-point grids and cell parameters from ROFF files.
//!
//! Nodes and cells are ordered with the third index fastest, which grows upwards. The second grows northwards, the
//! first eastwards. At a node each of the eight cells around it may have a height of its own. `splitEnz` gives the
//! number of heights at a node: 1 is one for all cells; 2 is one for the cells below and one for those above; 4 is
//! one each for the cells south-west, south-east, north-west and north-east of the node; 8 is four below, then four
//! above.

use glam::DVec3;

use super::budget::ReadBudget;
use super::options::ZPositive;
use super::roff::{Roff, Value};
use crate::corner_point::{CellProperty, CornerPointGrid, Pillar};

/// The values for "no value" in parameters: -999, 255 in bytes, or one of two huge numbers.
const NO_VALUE: f32 = -999.0;
const NO_CODE: f32 = 2e9;
const NO_BYTE: f32 = 255.0;

pub(super) fn grid(
    bytes: &[u8],
    positive: ZPositive,
    budget: &mut ReadBudget,
) -> Result<CornerPointGrid, String> {
    let roff = Roff::parse(bytes)?;
    if roff.text("filedata", "filetype").as_deref() == Some("parameter") {
        return Err(
            "it holds a parameter of a grid's cells and no grid: `antumbra prepare PARAMETER.roff --grid GRID.roff -o NAME.vol` makes a volume of both, and --volume NAME.vol shows it"
                .into(),
        );
    }
    let size = size(&roff)?;
    let [nx, ny, nz] = size.map(|cells| cells as usize);
    let units = UnitConversion::of(&roff, positive);
    let lines = roff.get("cornerLines", "data")?;
    let pillars = (nx + 1).saturating_mul(ny + 1);
    expect(lines, pillars.saturating_mul(6), "cornerLines")?;
    let nodes = pillars.saturating_mul(nz + 1);
    let heights = roff.get("zvalues", "data")?;
    let splits = roff.find("zvalues", "splitEnz");
    if let Some(splits) = splits {
        expect(splits, nodes, "splitEnz")?;
    } else {
        expect(heights, nodes, "zvalues without splitEnz")?;
    }
    // Without `splitEnz` each node has one height, and the file has at least that many numbers. The number of cells
    // is thus bounded by the file's length.
    let cells = nx.saturating_mul(ny).saturating_mul(nz);
    let active = roff.find("active", "data");
    if let Some(active) = active {
        expect(active, cells, "active")?;
    }
    budget.nodes(size)?;
    let pillars = pillars_of(lines, &units);
    let offsets = offsets(splits, nodes, heights.len())?;
    let heights = heights.numbers();
    let height = |node: usize, of_eight: usize| {
        let start = offsets.get(node).copied().unwrap_or_default();
        let end = offsets.get(node + 1).copied().unwrap_or_default();
        let at = match end - start {
            1 => 0,
            2 => of_eight / 4,
            4 => of_eight % 4,
            _ => of_eight,
        };
        let z = heights.get(start as usize + at).copied();
        z.map_or(f32::NAN, |z| units.height(z))
    };
    let mut corners = Vec::with_capacity(cells);
    for (i, j, k) in each(nx, ny, nz) {
        corners.push(std::array::from_fn(|corner| {
            let (east, north, top) = (corner & 1, corner >> 1 & 1, corner >> 2);
            let node = ((i + east) * (ny + 1) + j + north) * (nz + 1) + k + top;
            // The cell is on the opposite side of the node.
            height(node, 7 - corner)
        }));
    }
    let is_on = |values: &Value<'_>| values.numbers().iter().map(|&v| v != 0.0).collect();
    let active = active.map_or_else(|| vec![true; cells], is_on);
    Ok(CornerPointGrid::new(size, pillars, corners, active))
}

/// The parameter of this name, or the first one.
pub(super) fn property(bytes: &[u8], wanted: Option<&str>) -> Result<CellProperty, String> {
    let roff = Roff::parse(bytes)?;
    let size = size(&roff)?;
    let (found, data) = match wanted {
        None => {
            let data = roff.get("parameter", "data")?;
            (roff.text("parameter", "name").unwrap_or_default(), data)
        }
        Some(wanted) => {
            let data = roff.named("parameter", wanted, "data");
            let data = data.ok_or_else(|| {
                let names = roff.texts("parameter", "name").join(", ");
                format!("there is no parameter `{wanted}`: it has {names}")
            })?;
            (wanted.to_owned(), data)
        }
    };
    let cells = size
        .iter()
        .fold(1_usize, |all, &side| all.saturating_mul(side as usize));
    expect(data, cells, "parameter")?;
    let is_byte = data.is_of_bytes();
    let known = |value: &f32| {
        let is_nothing = *value == NO_VALUE || *value >= NO_CODE || (is_byte && *value == NO_BYTE);
        value.is_finite() && !is_nothing
    };
    let mut values = data.numbers();
    for value in values.iter_mut().filter(|value| !known(value)) {
        *value = f32::NAN;
    }
    if values.iter().all(|value| value.is_nan()) {
        return Err("every cell's value is undefined; there is nothing to show".into());
    }
    Ok(CellProperty {
        name: found,
        size,
        values,
    })
}

fn each(nx: usize, ny: usize, nz: usize) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..nx).flat_map(move |i| (0..ny).flat_map(move |j| (0..nz).map(move |k| (i, j, k))))
}

fn size(roff: &Roff<'_>) -> Result<[u32; 3], String> {
    let mut size = [0; 3];
    for (side, key) in size.iter_mut().zip(["nX", "nY", "nZ"]) {
        let cells = roff
            .number("dimensions", key)
            .ok_or_else(|| format!("tag `dimensions` with key `{key}` is missing"))?;
        // f32 is exact up to this number, and no grid is larger.
        if !(1.0..=16_000_000.0).contains(&cells) {
            return Err(format!("{key} is {cells}; a grid has at least one cell"));
        }
        *side = cells as u32;
    }
    Ok(size)
}

fn expect(value: &Value<'_>, count: usize, what: &str) -> Result<(), String> {
    if value.len() == count {
        return Ok(());
    }
    Err(format!(
        "{what} has {} values, and should have {count} by the dimensions",
        value.len()
    ))
}

/// The index of each node's first height, and the end of the last node's.
fn offsets(splits: Option<&Value<'_>>, nodes: usize, heights: usize) -> Result<Vec<u32>, String> {
    let ones = || vec![1.0; nodes];
    let splits = splits.map_or_else(ones, Value::numbers);
    let mut offsets = Vec::with_capacity(nodes + 1);
    let mut end = 0_u32;
    offsets.push(end);
    for (node, split) in splits.into_iter().enumerate() {
        if ![1.0, 2.0, 4.0, 8.0].contains(&split) {
            return Err(format!(
                "splitEnz {node} is {split}; it can be 1, 2, 4 or 8"
            ));
        }
        end = end
            .checked_add(split as u32)
            .ok_or("zvalues are too many to be counted in 32 bits")?;
        offsets.push(end);
    }
    if end as usize != heights {
        return Err(format!(
            "zvalues has {heights} values, and should have {end} by splitEnz"
        ));
    }
    Ok(offsets)
}

/// The conversion of the file's numbers to metres: `(number + offset) * scale`.
struct UnitConversion {
    offset: DVec3,
    scale: DVec3,
    positive: ZPositive,
}

impl UnitConversion {
    fn of(roff: &Roff<'_>, positive: ZPositive) -> Self {
        let three = |tag: &str, keys: [&str; 3], or: DVec3| {
            let [x, y, z] = keys.map(|key| roff.number(tag, key));
            DVec3::new(x.unwrap_or(or.x), y.unwrap_or(or.y), z.unwrap_or(or.z))
        };
        Self {
            offset: three("translate", ["xoffset", "yoffset", "zoffset"], DVec3::ZERO),
            scale: three(
                "scale",
                ["xscale", "yscale", "zscale"],
                DVec3::new(1.0, 1.0, -1.0),
            ),
            positive,
        }
    }

    fn height(&self, z: f32) -> f32 {
        let depth = (f64::from(z) + self.offset.z) * self.scale.z;
        self.positive.up(depth) as f32
    }

    fn point(&self, [x, y, z]: [f32; 3]) -> DVec3 {
        let file = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
        let metres = (file + self.offset) * self.scale;
        DVec3::new(metres.x, self.positive.up(metres.z), -metres.y)
    }
}

fn pillars_of(lines: &Value<'_>, units: &UnitConversion) -> Vec<Pillar> {
    let numbers = lines.numbers();
    let ends = numbers.as_chunks::<3>().0.as_chunks::<2>().0;
    ends.iter()
        .map(|&[bottom, top]| Pillar {
            bottom: units.point(bottom),
            top: units.point(top),
        })
        .collect()
}
