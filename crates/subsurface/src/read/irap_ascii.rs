//! Irap ASCII surfaces: a header of 19 numbers (`-996 rows step step`, the box, `columns rotation centre`, seven
//! integers), then the values.

use antumbra_formats::raster::text::{Tokens, decode, node_count};
use antumbra_scene::Raster;
use glam::DVec2;

use super::budget::ReadBudget;
use super::irap::{GridPlacement, height};
use super::options::ZPositive;

pub(super) fn read(
    bytes: &[u8],
    positive: ZPositive,
    budget: &mut ReadBudget,
) -> Result<Raster, String> {
    let text = decode(bytes);
    let mut words = Tokens::new(&text);
    if words.number("the format's number")? != -996.0 {
        return Err("it does not begin with -996".into());
    }
    let rows = words.count("the number of rows")?;
    let steps = pair(&mut words, "a step")?;
    let [west, _] = pair(&mut words, "west or east")?.to_array();
    let [south, _] = pair(&mut words, "south or north")?.to_array();
    let columns = words.count("the number of columns")?;
    let degrees = words.number("the rotation")?;
    let centre = pair(&mut words, "the rotation's centre")?;
    for _ in 0..7 {
        words.number("one of seven integers")?;
    }
    node_count(columns, rows, text.len() / 2 + 1)?;
    budget.horizon(columns, rows)?;
    let values = words.grid(columns, rows, text.len(), |_| false)?;
    let placement = GridPlacement {
        corner: DVec2::new(west, south),
        steps,
        degrees,
        centre,
    };
    let heights = values.into_iter().map(|value| height(value, positive));
    Ok(placement.raster(columns, rows, heights.collect()))
}

fn pair(words: &mut Tokens<'_>, what: &str) -> Result<DVec2, String> {
    Ok(DVec2::new(words.number(what)?, words.number(what)?))
}
