//! The boundaries between a grid's layers, as horizons.
//!
//! Corners on a pillar share a vertex only where their heights agree. Along a fault they do not agree, and its throw
//! becomes a gap.

use glam::DVec3;

use super::CornerPointGrid;
use crate::assemble;
use crate::error::SubsurfaceError;
use crate::progress::ProgressFn;
use crate::surface::{Surface, SurfaceKind};

/// Heights on a pillar that differ by less, in metres, are one vertex.
const AGREE: f64 = 1e-3;

impl CornerPointGrid {
    /// The top of every layer and the base of the lowest, from the top down. Boundaries without an active cell are
    /// left out. A cell's top is present where the cell is active; otherwise the base of the cell above is used where
    /// that cell is active.
    ///
    /// Quads are split along the diagonal that is shorter in space. The plan is the pillar's index divided by their
    /// number.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadSurface`] if no cell is active and has all its corners.
    pub fn surfaces(
        &self,
        name: &str,
        progress: ProgressFn<'_>,
    ) -> Result<Vec<Surface>, SubsurfaceError> {
        let layers = self.size[2];
        let mut surfaces = Vec::new();
        let is_mirrored = self.is_mirrored();
        for from_top in 0..=layers {
            progress(u64::from(from_top), u64::from(layers) + 1);
            let border = Border::new(self, layers - from_top, is_mirrored);
            let BorderMesh {
                points,
                triangles,
                plan,
            } = border.build();
            if triangles.is_empty() {
                continue;
            }
            let name = if from_top < layers {
                format!("{name}: top of layer {}", from_top + 1)
            } else {
                format!("{name}: base of layer {layers}")
            };
            let kind = SurfaceKind::Horizon;
            surfaces.push(assemble::surface(name, kind, &points, &triangles, plan));
        }
        if surfaces.is_empty() {
            let problem = "no cell is active and has all its corners; there is nothing to show";
            return Err(SubsurfaceError::BadSurface {
                surface: name.to_owned(),
                problem: problem.into(),
            });
        }
        Ok(surfaces)
    }

    /// Whether the direction of the first index turns clockwise into that of the second, viewed from above.
    pub(super) fn is_mirrored(&self) -> bool {
        let rows = self.size[1] as usize + 1;
        let at = |index: usize| self.pillars.get(index).map(|pillar| pillar.top);
        let turn = |index: usize| {
            let (here, next_i, next_j) = (at(index)?, at(index + rows)?, at(index + 1)?);
            let turn = (next_i - here).cross(next_j - here).y;
            turn.is_finite().then_some(turn)
        };
        let cells = (0..self.size[0] as usize)
            .flat_map(|i| (0..self.size[1] as usize).map(move |j| i * rows + j));
        cells.filter_map(turn).sum::<f64>() < 0.0
    }
}

/// The mesh of a border.
struct BorderMesh {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    plan: Vec<[f32; 2]>,
}

struct Border<'a> {
    grid: &'a CornerPointGrid,
    /// The layer above the boundary; the layer below has the preceding index.
    above: u32,
    is_mirrored: bool,
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    plan: Vec<[f32; 2]>,
    /// The vertices of each pillar. A boundary crosses a pillar at most four times.
    made: Vec<[u32; 4]>,
}

const UNMADE: u32 = u32::MAX;

impl<'a> Border<'a> {
    fn new(grid: &'a CornerPointGrid, above: u32, is_mirrored: bool) -> Self {
        Self {
            grid,
            above,
            is_mirrored,
            points: Vec::new(),
            triangles: Vec::new(),
            plan: Vec::new(),
            made: vec![[UNMADE; 4]; grid.pillars.len()],
        }
    }

    fn build(mut self) -> BorderMesh {
        for i in 0..self.grid.size[0] {
            for j in 0..self.grid.size[1] {
                if let Some(quad) = self.quad(i, j) {
                    self.split(i, j, quad);
                }
            }
        }
        BorderMesh {
            points: self.points,
            triangles: self.triangles,
            plan: self.plan,
        }
    }

    /// The corners of the boundary in a column of cells: south-west, south-east, north-west, north-east.
    fn quad(&self, i: u32, j: u32) -> Option<[DVec3; 4]> {
        let below = self.above.checked_sub(1).map(|k| ([i, j, k], 4));
        let above = (self.above < self.grid.size[2]).then_some(([i, j, self.above], 0));
        let sides = [below, above].into_iter().flatten();
        let mut shown = sides.filter(|(cell, _)| self.grid.is_active(*cell));
        shown.find_map(|(cell, first)| {
            let corners = self.grid.corners(cell)?;
            corners.get(first..first + 4)?.try_into().ok()
        })
    }

    fn split(&mut self, i: u32, j: u32, quad: [DVec3; 4]) {
        let [sw, se, nw, ne] = [(0, 0), (1, 0), (0, 1), (1, 1)];
        let vertices = [sw, se, nw, ne].map(|(east, north)| (i + east, j + north));
        let mut named = [0; 4];
        for ((name, place), point) in named.iter_mut().zip(vertices).zip(quad) {
            let Some(vertex) = self.vertex(place, point) else {
                return;
            };
            *name = vertex;
        }
        let [a, b, d, c] = named;
        let [sw, se, nw, ne] = quad;
        let triangles = if sw.distance_squared(ne) <= se.distance_squared(nw) {
            [[a, b, c], [a, c, d]]
        } else {
            [[a, b, d], [b, c, d]]
        };
        for [a, b, c] in triangles {
            self.triangles.push(match self.is_mirrored {
                true => [a, c, b],
                false => [a, b, c],
            });
        }
    }

    fn vertex(&mut self, (i, j): (u32, u32), point: DVec3) -> Option<u32> {
        let [nx, ny, _] = self.grid.size;
        let pillar = i as usize * (ny as usize + 1) + j as usize;
        let next = u32::try_from(self.points.len()).ok()?;
        let made = self.made.get_mut(pillar)?;
        for slot in made {
            if *slot == UNMADE {
                *slot = next;
                let share = |at: u32, of: u32| (f64::from(at) / f64::from(of)) as f32;
                self.points.push(point);
                self.plan.push([share(i, nx), share(j, ny)]);
            }
            let there = self.points.get(*slot as usize)?;
            if (there.y - point.y).abs() < AGREE {
                return Some(*slot);
            }
        }
        None
    }
}
