//! Horizons of the model: height fields with gaps.

use super::Model;
use super::extent::HALF;
use super::fault::{DisplacedPoint, broken_between, displace};
use crate::random::{Random, Stream};
use antumbra_scene::Raster;
use antumbra_subsurface::{SubsurfaceError, Surface};
use glam::DVec2;
use rayon::prelude::*;

/// Radius around the south-east corner in which the top horizon was not interpreted, in metres.
const CUT_OUT: f64 = 3300.0;

impl Model {
    /// Makes the surface of a horizon, counted from 0 at the top.
    ///
    /// Two kinds of cells are left out: cells that a fault breaks, and cells in the south-east corner, where the horizon
    /// was not interpreted. The higher a horizon, the larger this corner, so that the deeper horizons are visible.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadSurface`] if there is no such horizon, or if the faults break every cell of it.
    pub fn horizon(&self, horizon: usize) -> Result<Surface, SubsurfaceError> {
        let name = format!("horizon {horizon}");
        if horizon >= self.options.horizons as usize {
            return Err(SubsurfaceError::BadSurface {
                surface: name,
                problem: format!("the model's horizons are 0..{}", self.options.horizons),
            });
        }
        let grid = Grid::new(self, horizon);
        let side = self.options.nodes_per_side;
        let step = HALF * 2.0 / f64::from(side - 1);
        let elevation = grid.nodes.iter().map(|node| match node {
            Some(moved) => -moved.depth as f32,
            None => f32::NAN,
        });
        let field = Raster {
            columns: side,
            rows: side,
            origin: -HALF,
            step_u: DVec2::new(step.x, 0.0),
            step_v: DVec2::new(0.0, step.y),
            elevation: elevation.collect(),
        };
        Surface::from_raster_without_cells(&field, &name, |column, row| grid.is_broken(column, row))
    }

    /// Number of triangles of [`Self::horizon`].
    pub(super) fn horizon_triangles(&self, horizon: usize) -> u64 {
        let grid = Grid::new(self, horizon);
        let cells = 0..self.options.nodes_per_side - 1;
        let of_cell = |column: u32, row: u32| {
            if grid.is_broken(column, row) {
                return 0;
            }
            match grid.cell(column, row).into_iter().flatten().count() {
                4 => 2,
                3 => 1,
                _ => 0,
            }
        };
        let of_row = |row| {
            cells
                .clone()
                .map(|column| of_cell(column, row))
                .sum::<u64>()
        };
        cells.clone().map(of_row).sum()
    }
}

/// The nodes of a horizon, row by row; `None` where it was not interpreted.
struct Grid {
    side: u32,
    nodes: Vec<Option<DisplacedPoint>>,
}

impl Grid {
    fn new(model: &Model, horizon: usize) -> Self {
        let side = model.options.nodes_per_side;
        let outline = Outline::new(model, horizon);
        let share = |at: u32| f64::from(at) / f64::from(side - 1);
        let node = |column: u32, row: u32| {
            let place = HALF * (DVec2::new(share(column), share(row)) * 2.0 - 1.0);
            let depth = || model.layers.depth(horizon, place);
            let inside = outline.contains(place);
            inside.then(|| displace(&model.faults, place, depth()))
        };
        let rows = (0..side).into_par_iter();
        let nodes = rows.flat_map_iter(|row| (0..side).map(move |column| (column, row)));
        Self {
            side,
            nodes: nodes.map(|(column, row)| node(column, row)).collect(),
        }
    }

    /// The corners of a cell.
    fn cell(&self, column: u32, row: u32) -> [Option<DisplacedPoint>; 4] {
        [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(u, v)| {
            let at = (row + v) as usize * self.side as usize + (column + u) as usize;
            self.nodes.get(at).copied().flatten()
        })
    }

    /// Whether a fault breaks a cell.
    fn is_broken(&self, column: u32, row: u32) -> bool {
        let corners = self.cell(column, row);
        corners.iter().flatten().any(|corner| corner.in_gap) || broken_between(&corners)
    }
}

/// The border of the interpreted part of a horizon: everything except an area around the south-east corner.
struct Outline {
    radius: f64,
    /// Amplitude relative to the radius, waves per radian, phase.
    ripples: [[f64; 3]; 3],
}

impl Outline {
    fn new(model: &Model, horizon: usize) -> Self {
        let random = &mut Random::new(model.options.seed, Stream::Outlines);
        let ripples: [f64; 3] = [0.05, 0.02, 0.008];
        let mut ripples = ripples.map(|height| [height, 2.3 / height.sqrt(), random.angle()]);
        // The outlines of all horizons have one shape, with phases that differ slightly.
        for (number, ripple) in ripples.iter_mut().enumerate() {
            let [_, _, phase] = ripple;
            *phase += 0.25 * horizon as f64 * (number as f64 + 1.0);
        }
        let below = f64::from(model.options.horizons) - 1.0 - horizon as f64;
        Self {
            radius: CUT_OUT * below / f64::from(model.options.horizons),
            ripples,
        }
    }

    fn contains(&self, place: DVec2) -> bool {
        let from = place - DVec2::new(HALF.x, -HALF.y);
        let angle = from.y.atan2(-from.x);
        let ripples = self.ripples.iter();
        let ripple: f64 = ripples
            .map(|[height, wave, phase]| height * (wave * angle + phase).sin())
            .sum();
        self.radius <= 0.0 || from.length() >= self.radius * (1.0 + ripple)
    }
}
