//! Horizons of the model as height fields with gaps.

use super::chance::{Chance, Part};
use super::fault::{Moved, broken_between, displace};
use super::{HALF, Model};
use antumbra_scene::Raster;
use antumbra_subsurface::{SubsurfaceError, Surface};
use glam::DVec2;
use rayon::prelude::*;

/// How far from the south-east corner the top horizon was not interpreted, in metres.
const CUT_OUT: f64 = 3300.0;

pub(super) fn surface(model: &Model, horizon: usize) -> Result<Surface, SubsurfaceError> {
    let name = format!("horizon {horizon}");
    if horizon >= model.options.horizons as usize {
        return Err(SubsurfaceError::BadSurface {
            surface: name,
            problem: format!("the model's horizons are 0..{}", model.options.horizons),
        });
    }
    let grid = Grid::new(model, horizon);
    let side = model.options.nodes_per_side;
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

/// How many triangles that surface has.
pub(super) fn triangles(model: &Model, horizon: usize) -> u64 {
    let grid = Grid::new(model, horizon);
    let cells = 0..model.options.nodes_per_side - 1;
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

/// A horizon's nodes, a row after the other; `None` where it was not interpreted.
struct Grid {
    side: u32,
    nodes: Vec<Option<Moved>>,
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
    fn cell(&self, column: u32, row: u32) -> [Option<Moved>; 4] {
        [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(u, v)| {
            let at = (row + v) as usize * self.side as usize + (column + u) as usize;
            self.nodes.get(at).copied().flatten()
        })
    }

    /// Whether a fault breaks a cell.
    fn is_broken(&self, column: u32, row: u32) -> bool {
        let corners = self.cell(column, row);
        corners.iter().flatten().any(|corner| corner.cut) || broken_between(&corners)
    }
}

/// How far a horizon was interpreted: everywhere but around the south-east corner.
struct Outline {
    radius: f64,
    /// Height as a share of the radius, waves a radian, phase.
    ripples: [[f64; 3]; 3],
}

impl Outline {
    fn new(model: &Model, horizon: usize) -> Self {
        let chance = &mut Chance::new(model.options.seed, Part::Outlines);
        let ripples: [f64; 3] = [0.05, 0.02, 0.008];
        let mut ripples = ripples.map(|height| [height, 2.3 / height.sqrt(), chance.angle()]);
        // Steps of one outline, but not quite parallel ones.
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
