//! Shells: walls with an inner and an outer surface around the axis X, with openings cut through both.

use super::solid::{Sheet, Solid};
use glam::DVec3;

/// The grid of a shell: `rows` vertices along the axis, `columns` around it.
#[derive(Clone, Copy)]
pub(super) struct ShellGrid {
    pub rows: usize,
    pub columns: usize,
}

/// A surface of a shell.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum ShellSide {
    Inner,
    Outer,
}

impl Solid {
    /// Adds a shell without openings; `at(row, column, side)` gives the position of a vertex.
    pub fn shell(&mut self, wall: ShellGrid, at: impl Fn(usize, usize, ShellSide) -> DVec3) {
        self.shell_where(wall, at, |_, _| true);
    }

    /// Adds a shell without the cells for which `keep(row, column)` is false. At the edges of openings, faces join
    /// the inner and the outer surface.
    pub fn shell_where(
        &mut self,
        wall: ShellGrid,
        at: impl Fn(usize, usize, ShellSide) -> DVec3,
        keep: impl Fn(usize, usize) -> bool,
    ) {
        let ShellGrid { rows, columns } = wall;
        let (last, sheet) = (rows - 1, Sheet::round(rows, columns));
        self.sheet_where(sheet, |i, j| at(i, j, ShellSide::Inner), &keep);
        self.sheet_where(
            sheet,
            |i, j| at(last - i, j, ShellSide::Outer),
            |i, j| keep(last - 1 - i, j),
        );
        let side = |i: usize| match i {
            0 => ShellSide::Inner,
            _ => ShellSide::Outer,
        };
        for row in 0..last {
            for column in (0..columns).filter(|&column| keep(row, column)) {
                let after = (column + 1) % columns;
                let before = (column + columns - 1) % columns;
                let edge = Sheet::open(2, 2);
                if !keep(row, after) {
                    self.sheet(edge, |i, j| at(row + i, after, side(j)));
                }
                if !keep(row, before) {
                    self.sheet(edge, |i, j| at(row + j, column, side(i)));
                }
                let around = |j: usize| if j == 0 { column } else { after };
                if row + 1 == last || !keep(row + 1, column) {
                    self.sheet(edge, |i, j| at(row + 1, around(j), side(i)));
                }
                if row == 0 || !keep(row - 1, column) {
                    self.sheet(edge, |i, j| at(row, around(i), side(j)));
                }
            }
        }
    }
}
