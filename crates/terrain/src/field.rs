//! Height fields: triangle meshes that are single-valued over the plan, regular or not.
//!
//! A field keeps its vertices in metres east, north and up of an origin of its own, so that a field far from zero loses no precision. All
//! faults are found when the field is made, and each is reported with its position.

mod boundary;
mod check;
mod half_edge;
mod weld;

use glam::{DVec2, DVec3};

use crate::error::TerrainError;
use check::{Checked, Origin};

pub use boundary::Boundary;
pub use half_edge::{NONE, next, prev};

/// A triangle mesh that is single-valued over the plan.
///
/// A half-edge is a side of a triangle: half-edge `3 t + k` leads from corner `k` of triangle `t` to the next corner, with the triangle on
/// its left.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    origin: DVec3,
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// For each half-edge, the half-edge of the neighbouring triangle; [`NONE`] at the boundary.
    opposite: Vec<u32>,
    /// One half-edge for each edge.
    edges: Vec<u32>,
    boundary: Boundary,
}

impl Field {
    /// Makes a field of points in metres east, north and up, and of triangles of one winding. Points at one position are welded, and
    /// points without a triangle are dropped. The origin becomes the middle of the field, in whole metres.
    ///
    /// # Errors
    /// [`TerrainError::NotAHeightField`] with every fault's position, [`TerrainError::TooMany`].
    pub fn new(points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, TerrainError> {
        let checked = check::check(points, triangles, Origin::Centred)?;
        Ok(Self::from_checked(checked))
    }

    /// Makes a field about a given origin, which the points are relative to. Otherwise as [`Self::new`].
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_origin(
        origin: DVec3,
        points: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
    ) -> Result<Self, TerrainError> {
        let checked = check::check(points, triangles, Origin::Zero)?;
        let field = Self::from_checked(checked);
        Ok(Self { origin, ..field })
    }

    fn from_checked(checked: Checked) -> Self {
        Self {
            origin: checked.origin,
            points: checked.points,
            triangles: checked.triangles,
            opposite: checked.opposite,
            edges: checked.edges,
            boundary: checked.boundary,
        }
    }

    /// The field as the GPU draws it: every vertex rounded to f32. Horizons must be those of the drawn surface.
    ///
    /// # Errors
    /// [`TerrainError::NotAHeightField`] if rounding flips a triangle or leaves it without an area.
    pub fn rounded(self) -> Result<Self, TerrainError> {
        let round = |point: &DVec3| point.as_vec3().as_dvec3();
        let same = |point: &DVec3| round(point) == *point;
        if self.points.iter().all(same) {
            return Ok(self);
        }
        let points = self.points.iter().map(round).collect();
        // The origin stays: about another one the points would have to be rounded again.
        Self::with_origin(self.origin, points, self.triangles)
    }

    /// The origin of the field's coordinates, metres east, north and up.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The vertices, metres east, north and up of the origin.
    #[must_use]
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The triangles, counter-clockwise seen from above.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The boundary of the field, with its holes.
    #[must_use]
    pub fn boundary(&self) -> &Boundary {
        &self.boundary
    }

    /// One half-edge for each edge.
    #[must_use]
    pub fn edges(&self) -> &[u32] {
        &self.edges
    }

    /// For each half-edge, the index of its edge in [`Self::edges`].
    #[must_use]
    pub(crate) fn edge_indices(&self) -> Vec<u32> {
        let mut indices = vec![NONE; self.opposite.len()];
        for (index, &half_edge) in (0..).zip(&self.edges) {
            indices[half_edge as usize] = index;
            if let Some(other) = indices.get_mut(self.opposite(half_edge) as usize) {
                *other = index;
            }
        }
        indices
    }

    /// The half-edge of the neighbouring triangle at the same edge; [`NONE`] at the boundary.
    #[must_use]
    pub fn opposite(&self, half_edge: u32) -> u32 {
        let opposite = self.opposite.get(half_edge as usize);
        opposite.copied().unwrap_or(NONE)
    }

    /// The vertex that a half-edge starts at.
    #[must_use]
    pub fn start(&self, half_edge: u32) -> u32 {
        let corners = &self.triangles[half_edge as usize / 3];
        corners[half_edge as usize % 3]
    }

    /// The vertex that a half-edge ends at.
    #[must_use]
    pub fn end(&self, half_edge: u32) -> u32 {
        self.start(next(half_edge))
    }

    /// A vertex, metres east, north and up of the origin.
    #[must_use]
    pub fn point(&self, vertex: u32) -> DVec3 {
        self.points[vertex as usize]
    }

    /// The corners of a triangle, metres east, north and up of the origin.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|vertex| self.point(vertex))
    }

    /// The start and the end of a half-edge, metres east, north and up of the origin.
    #[must_use]
    pub fn ends(&self, half_edge: u32) -> [DVec3; 2] {
        [
            self.point(self.start(half_edge)),
            self.point(self.end(half_edge)),
        ]
    }

    /// The bounding box of the field in the plan: its lowest and its highest corner.
    #[must_use]
    pub fn plan_bounds(&self) -> [DVec2; 2] {
        let plan = self.points.iter().map(|point| point.truncate());
        let empty = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        plan.fold(empty, |[low, high], at| [low.min(at), high.max(at)])
    }

    /// The edges at the vertex that a half-edge starts at, one half-edge for each, of either direction.
    pub(crate) fn edges_around_start(&self, half_edge: u32) -> Vec<u32> {
        let mut edges = vec![half_edge];
        let mut at = half_edge;
        loop {
            // Counter-clockwise: the side that leads back to the vertex starts at it in the neighbouring triangle.
            let back = prev(at);
            edges.push(back);
            at = self.opposite(back);
            if at == half_edge {
                return edges;
            }
            if at == NONE {
                break;
            }
        }
        // The walk ended at the boundary. The remaining edges lie clockwise of the first.
        let mut at = self.opposite(half_edge);
        while at != NONE {
            let out = next(at);
            edges.push(out);
            at = self.opposite(out);
        }
        edges
    }
}
