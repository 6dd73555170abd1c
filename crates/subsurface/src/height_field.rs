//! Horizons from rasters.
//!
//! A cell is split along the diagonal that is shorter in space, so that ridges and valleys keep their shape. A cell
//! with three known corners becomes one triangle, and a cell with fewer becomes a hole.

use antumbra_scene::{Geometry, Raster};
use glam::DVec3;

use crate::error::SubsurfaceError;
use crate::surface::{Surface, SurfaceKind};

impl Surface {
    /// The horizon over all cells of a raster, with smooth normals.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadSurface`] for fewer than 2 x 2 nodes, a number of elevations that differs from the
    /// number of nodes, steps that are not finite or span no area, and a raster that gives no triangle.
    pub fn from_raster(raster: &Raster, name: &str) -> Result<Self, SubsurfaceError> {
        Self::from_raster_without_cells(raster, name, |_, _| false)
    }

    /// The horizon over a raster without some cells. `dropped(column, row)` tells whether the cell with this lowest
    /// node is left out.
    ///
    /// # Errors
    /// As for [`Surface::from_raster`].
    pub fn from_raster_without_cells(
        raster: &Raster,
        name: &str,
        dropped: impl Fn(u32, u32) -> bool,
    ) -> Result<Self, SubsurfaceError> {
        let bad = |problem: String| SubsurfaceError::BadSurface {
            surface: name.to_owned(),
            problem,
        };
        if let Some(problem) = raster.problem() {
            return Err(bad(problem));
        }
        let origin = raster
            .centre()
            .ok_or_else(|| bad("every node is undefined; there is nothing to show".into()))?;
        let mut mesh = Builder::new(raster, origin);
        for row in 0..raster.rows - 1 {
            mesh.next_row();
            for column in 0..raster.columns - 1 {
                if !dropped(column, row) {
                    mesh.cell(column, row);
                }
            }
        }
        if mesh.geometry.indices.is_empty() {
            let problem = "no three nodes of a cell are defined; there is nothing to show";
            return Err(bad(problem.into()));
        }
        Ok(Self {
            name: name.to_owned(),
            kind: SurfaceKind::Horizon,
            origin,
            geometry: mesh.geometry.with_computed_normals(),
            plan: mesh.plan,
        })
    }
}

/// The mesh under construction. A vertex is made when its first triangle is added. Two rows of vertices are kept.
struct Builder<'a> {
    field: &'a Raster,
    origin: DVec3,
    /// Whether the steps turn clockwise, viewed from above.
    mirrored: bool,
    /// The vertex of each node of the lower and the upper row of cells, [`UNMADE`] before it is made.
    lower: Vec<u32>,
    upper: Vec<u32>,
    geometry: Geometry,
    plan: Vec<[f32; 2]>,
}

const UNMADE: u32 = u32::MAX;

impl<'a> Builder<'a> {
    fn new(field: &'a Raster, origin: DVec3) -> Self {
        let empty = vec![UNMADE; field.columns as usize];
        Self {
            field,
            origin,
            mirrored: field.step_u.perp_dot(field.step_v) < 0.0,
            lower: empty.clone(),
            upper: empty,
            geometry: Geometry::default(),
            plan: Vec::new(),
        }
    }

    fn next_row(&mut self) {
        std::mem::swap(&mut self.lower, &mut self.upper);
        self.upper.fill(UNMADE);
    }

    fn cell(&mut self, column: u32, row: u32) {
        // Around the cell, counter-clockwise where the steps are right-handed.
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
        let [a, b, c, d] = corners.map(|(u, v)| self.field.position(column + u, row + v));
        let long = |from: Option<DVec3>, to: Option<DVec3>| match (from, to) {
            (Some(from), Some(to)) => from.distance_squared(to),
            _ => f64::INFINITY,
        };
        if long(a, c) <= long(b, d) {
            self.triangle(column, row, [(0, 0), (1, 0), (1, 1)]);
            self.triangle(column, row, [(0, 0), (1, 1), (0, 1)]);
        } else {
            self.triangle(column, row, [(0, 0), (1, 0), (0, 1)]);
            self.triangle(column, row, [(1, 0), (1, 1), (0, 1)]);
        }
    }

    fn triangle(&mut self, column: u32, row: u32, corners: [(u32, u32); 3]) {
        let known = |(u, v): (u32, u32)| self.field.elevation_at(column + u, row + v).is_some();
        if !corners.into_iter().all(known) {
            return;
        }
        let [Some(a), Some(b), Some(c)] = corners.map(|(u, v)| self.vertex(column + u, row, v))
        else {
            return;
        };
        let corners = if self.mirrored { [a, c, b] } else { [a, b, c] };
        self.geometry.indices.extend(corners);
    }

    fn vertex(&mut self, column: u32, row: u32, upper: u32) -> Option<u32> {
        let row = row + upper;
        let made = if upper == 0 {
            &mut self.lower
        } else {
            &mut self.upper
        };
        let slot = made.get_mut(column as usize)?;
        if *slot == UNMADE {
            let node = self.field.position(column, row)?;
            *slot = u32::try_from(self.geometry.positions.len()).ok()?;
            let position = (node - self.origin).as_vec3();
            self.geometry.positions.push(position.to_array());
            let share = |at: u32, of: u32| (f64::from(at) / f64::from(of - 1)) as f32;
            let (columns, rows) = (self.field.columns, self.field.rows);
            self.plan.push([share(column, columns), share(row, rows)]);
        }
        Some(*slot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, Vec3};

    fn field(columns: u32, rows: u32, height: impl Fn(u32, u32) -> f32) -> Raster {
        let nodes = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        Raster {
            columns,
            rows,
            origin: DVec2::new(460_000.0, 5_930_000.0),
            step_u: DVec2::new(20.0, 0.0),
            step_v: DVec2::new(0.0, 25.0),
            elevation: nodes.map(|(column, row)| height(column, row)).collect(),
        }
    }

    fn normals(surface: &Surface) -> Vec<Vec3> {
        let corners = |triangle| surface.geometry.corners(triangle).unwrap();
        let faces = surface.geometry.triangles().map(corners);
        faces
            .map(|[a, b, c]| (b - a).cross(c - a).as_vec3())
            .collect()
    }

    #[test]
    fn triangles_look_up_whichever_way_the_steps_turn() {
        let steps = [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
        for (u, v) in steps {
            let mut rotated = field(4, 3, |column, row| (column * row) as f32);
            rotated.step_u = DVec2::new(20.0 * u, 3.0);
            rotated.step_v = DVec2::new(-4.0, 25.0 * v);
            let surface = Surface::from_raster(&rotated, "rotated").unwrap();
            assert_eq!(surface.geometry.triangle_count(), 12);
            assert!(normals(&surface).iter().all(|normal| normal.y > 0.0));
            assert!(
                surface
                    .geometry
                    .normals
                    .iter()
                    .all(|normal| normal[1] > 0.0)
            );
        }
    }

    #[test]
    fn nodes_keep_their_places_far_from_zero() {
        let field = field(5, 6, |column, row| {
            -1000.0 - column as f32 + 2.0 * row as f32
        });
        let surface = Surface::from_raster(&field, "far").unwrap();
        assert_eq!(surface.geometry.positions.len(), 30);
        for (position, plan) in surface.geometry.positions.iter().zip(&surface.plan) {
            let (column, row) = ((plan[0] * 4.0).round(), (plan[1] * 5.0).round());
            let world = surface.origin + Vec3::from(*position).as_dvec3();
            let node = field.position(column as u32, row as u32).unwrap();
            assert!(world.distance(node) < 1e-4, "{world} is not {node}");
        }
    }

    #[test]
    fn a_plane_has_the_planes_normal_everywhere() {
        let surface =
            Surface::from_raster(&field(7, 5, |column, _| column as f32 * 20.0), "plane").unwrap();
        let expected = Vec3::new(-1.0, 1.0, 0.0).normalize();
        for normal in surface.geometry.normals {
            assert!(Vec3::from(normal).distance(expected) < 1e-5);
        }
    }

    #[test]
    fn a_cell_with_three_corners_is_a_triangle_and_with_two_a_hole() {
        for (column, row) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let mut one = field(2, 2, |_, _| 1.0);
            one.elevation[row * 2 + column] = f32::NAN;
            let surface = Surface::from_raster(&one, "three").unwrap();
            assert_eq!(surface.geometry.positions.len(), 3);
            assert!(normals(&surface)[0].y > 0.0);
            one.elevation[(1 - row) * 2 + column] = f32::INFINITY;
            assert!(Surface::from_raster(&one, "two").is_err());
        }
    }

    #[test]
    fn a_ridge_is_not_cut_across() {
        for heights in [[0.0, 50.0, 50.0, 100.0], [50.0, 0.0, 100.0, 50.0]] {
            let mut tilted = field(2, 2, |_, _| 0.0);
            tilted.elevation = heights.to_vec();
            let geometry = Surface::from_raster(&tilted, "tilted").unwrap().geometry;
            let high = |i: &u32| geometry.positions[*i as usize][1].abs() < 1e-3;
            let level = geometry.indices.iter().filter(|i| high(i)).count();
            assert_eq!(level, 4, "both triangles share the level diagonal");
        }
    }

    #[test]
    fn dropped_cells_leave_a_hole_and_keep_their_nodes_for_others() {
        let surface =
            Surface::from_raster_without_cells(&field(4, 4, |_, _| 0.0), "gap", |column, row| {
                column == 1 && row == 1
            })
            .unwrap();
        assert_eq!(surface.geometry.triangle_count(), 16);
        assert_eq!(surface.geometry.positions.len(), 16);
    }

    #[test]
    fn what_makes_no_surface_is_refused() {
        let good = field(3, 3, |_, _| 0.0);
        let refused = |change: &dyn Fn(&mut Raster), word: &str| {
            let mut bad = good.clone();
            change(&mut bad);
            let error = Surface::from_raster(&bad, "bad").unwrap_err().to_string();
            assert!(error.contains(word), "{error}");
        };
        refused(&|bad| bad.columns = 1, "no cell");
        refused(&|bad| bad.rows = 0, "no cell");
        refused(&|bad| bad.rows = u32::MAX, "elevations");
        refused(&|bad| bad.elevation.fill(f32::NAN), "undefined");
        refused(&|bad| bad.step_u = bad.step_v * 2.0, "no area");
        refused(&|bad| bad.step_u = DVec2::ZERO, "no area");
        refused(&|bad| bad.origin.x = f64::NAN, "beyond");
        refused(&|bad| bad.step_v.y = 1e39, "beyond");
    }
}
