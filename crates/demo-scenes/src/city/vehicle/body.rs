//! Vehicle bodies: thin shells along X through sections, with openings for windows and wheel arches.

use crate::shell::{ShellGrid, ShellSide};
use crate::solid::Solid;
use glam::DVec3;
use std::f64::consts::TAU;

/// A section of a body.
#[derive(Clone, Copy)]
pub(super) struct Section {
    pub x: f64,
    pub bottom: f64,
    pub top: f64,
    /// Half its width.
    pub half: f64,
}

/// A body.
pub(super) struct Body<'a> {
    /// Sections from the rear to the front: [x, bottom, top, half width].
    pub sections: &'a [[f64; 4]],
    /// Height above which the body gets narrower, and the relative decrease of its width per metre.
    pub belt: [f64; 2],
    /// Centres of the wheel arches (x, height), and their radius.
    pub arches: &'a [[f64; 2]],
    pub arch: f64,
    /// Columns around.
    pub columns: usize,
    /// Power of the superellipse of a section: 2 is an ellipse.
    pub power: f64,
}

const THICK: f64 = 0.03;
/// Sections over a wheel arch.
const OVER: usize = 8;
/// Maximum distance between sections elsewhere, in metres.
const STEP: f64 = 0.13;

impl Body<'_> {
    /// The shell without the cells around positions for which `open` is true.
    pub fn shell(&self, open: impl Fn(DVec3) -> bool) -> Solid {
        let rows = self.rows();
        let wall = ShellGrid {
            rows: rows.len(),
            columns: self.columns,
        };
        let on = |row: usize, column: f64, inside: f64| self.on(&rows[row], column, inside);
        let mut solid = Solid::default();
        solid.shell_where(
            wall,
            |row, column, side| {
                let inset = match side {
                    ShellSide::Outer => 0.0,
                    ShellSide::Inner => THICK,
                };
                on(row, column as f64, inset)
            },
            |row, column| {
                let column = column as f64 + 0.5;
                let middle = on(row, column, 0.0).midpoint(on(row + 1, column, 0.0));
                !open(middle)
            },
        );
        // Plates close the ends; their edges are inside the shell.
        for (end, inwards) in [(rows.first(), 1.0), (rows.last(), -1.0)] {
            let Some(end) = end else { continue };
            let face = |depth: f64| -> Vec<DVec3> {
                let shift = DVec3::X * (inwards * depth);
                let corner = |column| self.on(end, column as f64, 0.6 * THICK) + shift;
                (0..self.columns).map(corner).collect()
            };
            let mut faces = [face(0.004), face(0.024)];
            if inwards < 0.0 {
                faces.reverse();
            }
            solid.faceted_loft(&faces);
        }
        solid
    }

    fn on(&self, section: &Section, column: f64, inside: f64) -> DVec3 {
        let bent = |part: f64| part.signum() * part.abs().powf(2.0 / self.power);
        // The centre of the first column is the top.
        let (sin, cos) = (TAU * (column - 0.5) / self.columns as f64).sin_cos();
        let middle = 0.5 * (section.bottom + section.top);
        let high = 0.5 * (section.top - section.bottom) - inside;
        let y = middle + high * bent(cos);
        let [belt, narrower] = self.belt;
        let wide = section.half * (1.0 - narrower * (y - belt).max(0.0)) - inside;
        DVec3::new(section.x, y, wide * bent(sin))
    }

    /// Sections from the rear to the front, close together, with two at each end of a wheel arch.
    fn rows(&self) -> Vec<Section> {
        let mut places: Vec<(f64, bool)> = Vec::new();
        for pair in self.sections.windows(2) {
            let (from, to) = (pair[0][0], pair[1][0]);
            let steps = ((to - from) / STEP).ceil().max(1.0) as usize;
            let part = |i: usize| from + (to - from) * i as f64 / steps as f64;
            places.extend((0..steps).map(|i| (part(i), false)));
        }
        places.extend(self.sections.last().map(|last| (last[0], false)));
        let off_arches = |x: f64| {
            let near = |arch: &[f64; 2]| (x - arch[0]).abs() < self.arch + 0.02;
            !self.arches.iter().any(near)
        };
        places.retain(|(x, _)| off_arches(*x));
        for &[x, _] in self.arches {
            for i in 0..=OVER {
                let part = (i as f64 / OVER as f64 - 0.5) * TAU * 0.5;
                places.push((x + self.arch * part.sin(), true));
            }
            for end in [-1.0, 1.0] {
                places.push((x + end * (self.arch + 0.004), false));
            }
        }
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let section = |(x, over): (f64, bool)| {
            let section = self.at(x);
            let rise = self.arches.iter().map(|arch| {
                let off = x - arch[0];
                arch[1] + (self.arch * self.arch - off * off).max(0.0).sqrt()
            });
            let over_arch = rise.fold(0.0, f64::max);
            Section {
                bottom: if over {
                    section.bottom.max(over_arch.min(section.top - 0.15))
                } else {
                    section.bottom
                },
                ..section
            }
        };
        places.into_iter().map(section).collect()
    }

    fn at(&self, x: f64) -> Section {
        let mut found = self.sections.first().copied().unwrap_or_default();
        for pair in self.sections.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            if x >= from[0] {
                let part = ((x - from[0]) / (to[0] - from[0])).min(1.0);
                found = std::array::from_fn(|i| from[i] + (to[i] - from[i]) * part);
            }
        }
        let [_, bottom, top, half] = found;
        Section {
            x,
            bottom,
            top,
            half,
        }
    }
}

/// The body of a saloon, with openings for its windows.
pub(super) fn saloon() -> Solid {
    let body = Body {
        sections: &[
            [-2.2, 0.42, 0.86, 0.72],
            [-2.16, 0.32, 0.96, 0.80],
            [-2.0, 0.25, 1.03, 0.85],
            [-1.6, 0.22, 1.08, 0.88],
            [-1.4, 0.22, 1.1, 0.88],
            [-0.95, 0.22, 1.4, 0.88],
            [-0.6, 0.22, 1.47, 0.88],
            [0.0, 0.22, 1.49, 0.88],
            [0.35, 0.22, 1.45, 0.88],
            [1.0, 0.22, 1.04, 0.88],
            [1.3, 0.22, 0.99, 0.87],
            [1.8, 0.24, 0.91, 0.85],
            [2.1, 0.3, 0.82, 0.8],
            [2.2, 0.42, 0.7, 0.72],
        ],
        belt: [0.92, 0.42],
        arches: &[[-1.3, 0.31], [1.38, 0.31]],
        arch: 0.37,
        columns: 32,
        power: 4.5,
    };
    body.shell(|at| {
        let beside = at.z.abs() > 0.55 && (0.98..1.36).contains(&at.y);
        let doors = (-0.92..-0.12).contains(&at.x) || (0.0..0.7).contains(&at.x);
        let above = at.y > 1.0 && at.z.abs() < 0.56;
        let screens = (0.42..0.97).contains(&at.x) || (-1.36..-0.99).contains(&at.x);
        beside && doors || above && screens
    })
}

/// The body of a van, with windows only in front of and beside the driver.
pub(super) fn van() -> Solid {
    let body = Body {
        sections: &[
            [-2.6, 0.5, 2.1, 0.86],
            [-2.56, 0.3, 2.2, 0.92],
            [-2.3, 0.26, 2.22, 0.94],
            [0.6, 0.26, 2.22, 0.94],
            [1.0, 0.26, 2.14, 0.94],
            [1.3, 0.26, 1.9, 0.94],
            [1.95, 0.26, 1.24, 0.94],
            [2.3, 0.27, 1.12, 0.92],
            [2.55, 0.34, 0.95, 0.87],
            [2.62, 0.45, 0.8, 0.8],
        ],
        belt: [1.1, 0.12],
        arches: &[[-1.55, 0.33], [1.75, 0.33]],
        arch: 0.39,
        columns: 32,
        power: 6.0,
    };
    body.shell(|at| {
        let beside = at.z.abs() > 0.7 && (1.14..1.86).contains(&at.y);
        let doors = (0.5..1.3).contains(&at.x);
        let before = at.y > 1.2 && at.z.abs() < 0.74 && (1.2..1.93).contains(&at.x);
        beside && doors || before
    })
}
