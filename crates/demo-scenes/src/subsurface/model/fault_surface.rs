//! Triangle meshes of the faults: a grid along strike and dip inside the tip line.

use super::Model;
use super::extent::world;
use super::fault::{ModelFault, displace};
use antumbra_scene::Geometry;
use antumbra_subsurface::{SubsurfaceError, Surface, SurfaceKind};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Distance between two nodes in the full model, in metres.
const SPACING: f64 = 32.0;
/// The part of its height that a fault keeps at its ends, so that every triangle has an area.
const BLUNT: f64 = 0.12;

impl Model {
    /// Makes the surface of a fault, counted from 0, the oldest.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadSurface`] if there is no such fault.
    pub fn fault(&self, number: usize) -> Result<Surface, SubsurfaceError> {
        let name = format!("fault {number}");
        let Some((fault, younger)) =
            (self.faults.get(number..)).and_then(<[ModelFault]>::split_first)
        else {
            return Err(SubsurfaceError::BadSurface {
                surface: name,
                problem: format!("the model's faults are 0..{}", self.faults.len()),
            });
        };
        let origin = world(fault.centre, fault.depth);
        let [columns, rows] = cells(self, fault);
        let node = |column: u32, row: u32| -> DVec3 {
            // Columns are closer together towards the ends, where the tip line bends.
            let end = (f64::from(column) / f64::from(columns) * 2.0 - 1.0) * FRAC_PI_2;
            let along = fault.half_length * end.sin();
            let height = BLUNT + (1.0 - BLUNT) * end.cos();
            let down = f64::from(row) / f64::from(rows) * 2.0 - 1.0;
            let depth = fault.depth + fault.half_depth() * height * down;
            let [strike, dip] = fault.axes;
            let place = fault.centre + strike * along + dip * fault.across(along, depth);
            world(place, displace(younger, place, depth).depth)
        };
        let nodes = (0..=rows).flat_map(|row| (0..=columns).map(move |column| (column, row)));
        let positions =
            nodes.map(|(column, row)| (node(column, row) - origin).as_vec3().to_array());
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let indices = cells.flat_map(|(column, row)| {
            let at = |u: u32, v: u32| (row + v) * (columns + 1) + column + u;
            // Counter-clockwise, seen from the hanging wall.
            [at(0, 0), at(0, 1), at(1, 1), at(0, 0), at(1, 1), at(1, 0)]
        });
        let geometry = Geometry {
            positions: positions.collect(),
            indices: indices.collect(),
            ..Geometry::default()
        };
        Ok(Surface {
            name,
            kind: SurfaceKind::Fault,
            origin,
            geometry: geometry.with_computed_normals(),
            plan: Vec::new(),
        })
    }

    /// Number of triangles of [`Self::fault`].
    pub(super) fn fault_triangles(&self, fault: &ModelFault) -> u64 {
        let [columns, rows] = cells(self, fault);
        u64::from(columns) * u64::from(rows) * 2
    }
}

/// Number of cells along strike and dip.
fn cells(model: &Model, fault: &ModelFault) -> [u32; 2] {
    let sides = [fault.half_length, fault.half_height];
    sides.map(|half| {
        ((half * 2.0 / SPACING * model.options.relative_resolution()).round() as u32).max(2)
    })
}
