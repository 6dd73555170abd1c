//! Grids in text whose values go down their columns: from north to south, one column after the other from west to east.

use antumbra_formats::raster::text::{Tokens, node_count};
use antumbra_scene::Raster;
use glam::DVec2;

use super::budget::ReadBudget;
use super::options::ZPositive;

/// What a header says of such a grid.
pub(super) struct ColumnGrid {
    pub(super) columns: u32,
    pub(super) rows: u32,
    /// The least and the greatest x and y of its nodes, in the file's units.
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

impl ColumnGrid {
    /// The raster of the values in `text`.
    pub(super) fn read(
        &self,
        text: &str,
        positive: ZPositive,
        budget: &mut ReadBudget,
        is_undefined: impl Fn(f64) -> bool,
    ) -> Result<Raster, String> {
        let Self { columns, rows, .. } = *self;
        node_count(columns, rows, text.len() / 2 + 1)?;
        budget.horizon(columns, rows)?;
        let values = Tokens::new(text).grid(columns, rows, text.len(), is_undefined)?;
        let steps = DVec2::new(f64::from(columns - 1), f64::from(rows - 1));
        let step = (self.high - self.low) / steps;
        Ok(Raster {
            // The file's columns are the raster's rows.
            columns: rows,
            rows: columns,
            origin: DVec2::new(self.low.x, self.high.y),
            step_u: DVec2::new(0.0, -step.y),
            step_v: DVec2::new(step.x, 0.0),
            elevation: values.into_iter().map(|z| positive.up(z) as f32).collect(),
        })
    }
}
