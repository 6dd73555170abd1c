//! Walls: what has an inner and an outer surface around the axis X, with openings cut through both.

use super::solid::{Sheet, Solid};
use glam::DVec3;

/// A wall as a grid of cells: `rows` corners rearwards, `columns` around.
#[derive(Clone, Copy)]
pub(super) struct Wall {
    pub rows: usize,
    pub columns: usize,
}

impl Solid {
    /// Adds a wall whose corners lie where `at(row, column, outside)` says, whole.
    pub fn wall(&mut self, wall: Wall, at: impl Fn(usize, usize, bool) -> DVec3) {
        self.wall_where(wall, at, |_, _| true);
    }

    /// The same without the cells for which `keep` is false; where cells end, the wall is closed between inside and outside.
    pub fn wall_where(
        &mut self,
        wall: Wall,
        at: impl Fn(usize, usize, bool) -> DVec3,
        keep: impl Fn(usize, usize) -> bool,
    ) {
        let Wall { rows, columns } = wall;
        let (last, sheet) = (rows - 1, Sheet::round(rows, columns));
        self.sheet_where(sheet, |i, j| at(i, j, false), &keep);
        self.sheet_where(
            sheet,
            |i, j| at(last - i, j, true),
            |i, j| keep(last - 1 - i, j),
        );
        for row in 0..last {
            for column in (0..columns).filter(|&column| keep(row, column)) {
                let after = (column + 1) % columns;
                let before = (column + columns - 1) % columns;
                let edge = Sheet::open(2, 2);
                if !keep(row, after) {
                    self.sheet(edge, |i, j| at(row + i, after, j == 1));
                }
                if !keep(row, before) {
                    self.sheet(edge, |i, j| at(row + j, column, i == 1));
                }
                let around = |j: usize| if j == 0 { column } else { after };
                if row + 1 == last || !keep(row + 1, column) {
                    self.sheet(edge, |i, j| at(row + 1, around(j), i == 1));
                }
                if row == 0 || !keep(row - 1, column) {
                    self.sheet(edge, |i, j| at(row, around(i), j == 1));
                }
            }
        }
    }
}
