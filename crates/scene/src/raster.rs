//! Rasters: elevations on a regular grid.

use glam::{DVec2, DVec3};

/// The greatest distance of a coordinate from zero, in metres. It is far beyond any place on Earth.
const MAX_COORDINATE: f64 = 1e12;

/// Elevations on a regular grid in the horizontal plane. The grid may be rotated, and its steps may have either
/// handedness.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    /// The number of nodes along `step_u`.
    pub columns: u32,
    /// The number of nodes along `step_v`.
    pub rows: u32,
    /// The position of node (0, 0), metres east and north.
    pub origin: DVec2,
    /// The step from a column to the next, metres east and north.
    pub step_u: DVec2,
    /// The step from a row to the next, metres east and north.
    pub step_v: DVec2,
    /// Elevations in metres, positive up: `columns * rows` values, row by row. A value that is not finite (usually
    /// NaN) or beyond 1e12 is a hole.
    pub elevation: Vec<f32>,
}

impl Raster {
    /// The elevation of a node; `None` in a hole and outside the grid.
    #[must_use]
    pub fn elevation_at(&self, column: u32, row: u32) -> Option<f32> {
        if column >= self.columns || row >= self.rows {
            return None;
        }
        let index = row as usize * self.columns as usize + column as usize;
        let height = self.elevation.get(index).copied();
        height.filter(is_known)
    }

    /// The position of a node in the world, Y up and Z south; `None` in a hole and outside the grid.
    #[must_use]
    pub fn position(&self, column: u32, row: u32) -> Option<DVec3> {
        let height = self.elevation_at(column, row)?;
        let plan = self.plan_position(column, row);
        Some(DVec3::new(plan.x, f64::from(height), -plan.y))
    }

    /// The horizontal position of a node, metres east and north.
    #[must_use]
    pub fn plan_position(&self, column: u32, row: u32) -> DVec2 {
        self.origin + self.step_u * f64::from(column) + self.step_v * f64::from(row)
    }

    /// The centre of the grid at half the range of its known elevations, in the world; `None` if no elevation is
    /// known.
    #[must_use]
    pub fn centre(&self) -> Option<DVec3> {
        let known = self.elevation.iter().filter(|height| is_known(height));
        let (low, high) = known.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &h| {
            (low.min(h), high.max(h))
        });
        let height = f64::midpoint(f64::from(low), f64::from(high));
        let last = [self.columns, self.rows].map(|count| count.saturating_sub(1));
        let plan = (self.plan_position(0, 0) + self.plan_position(last[0], last[1])) * 0.5;
        (low <= high).then(|| DVec3::new(plan.x, height, -plan.y))
    }

    /// A description of the first value from which no surface can be built; `None` if the raster is valid. Holes are
    /// valid.
    #[must_use]
    pub fn problem(&self) -> Option<String> {
        let (columns, rows) = (self.columns, self.rows);
        if columns < 2 || rows < 2 {
            return Some(format!(
                "{columns} x {rows} nodes make no cell; give at least 2 x 2"
            ));
        }
        let nodes = u64::from(columns) * u64::from(rows);
        if nodes != self.elevation.len() as u64 || nodes > u64::from(u32::MAX) {
            return Some(format!(
                "{columns} x {rows} nodes, but {} elevations; give one each, at most {} of them",
                self.elevation.len(),
                u32::MAX
            ));
        }
        let span = self.step_u * f64::from(columns) + self.step_v * f64::from(rows);
        let area = self.step_u.perp_dot(self.step_v);
        let far = self.origin.abs() + self.step_u.abs() * f64::from(columns) + span.abs();
        if !far.is_finite() || far.max_element() > MAX_COORDINATE {
            return Some(format!(
                "origin {} and steps {}, {} reach beyond what can be drawn",
                self.origin, self.step_u, self.step_v
            ));
        }
        (area == 0.0 || !area.is_finite()).then(|| {
            format!(
                "steps {} and {} span no area; give two that are neither zero nor parallel",
                self.step_u, self.step_v
            )
        })
    }
}

/// Whether an elevation is a known value.
fn is_known(height: &f32) -> bool {
    f64::from(height.abs()) <= MAX_COORDINATE
}
