//! Height fields: triangle meshes that are single-valued over the plan, whatever their triangles are.
//!
//! A height field keeps its corners in metres east, north and up of an origin of its own, so that fields far from zero lose nothing.
//! Everything about it that can be wrong is found once, when it is made, and named with its place.

mod check;
mod fault;
mod outline;
mod weld;

use glam::{DVec2, DVec3};

use crate::error::TerrainError;

pub use fault::Fault;
pub use outline::Outline;
pub(crate) use outline::around;

/// Stands for no triangle, no edge and no vertex.
pub const NONE: u32 = u32::MAX;

/// A triangle mesh that is single-valued over the plan.
///
/// A half-edge is a side of a triangle: half-edge `3 t + k` leads from corner `k` of triangle `t` to the next one, and has the triangle on
/// its left.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    origin: DVec3,
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// For each half-edge, the one that runs the other way; [`NONE`] at the border.
    across: Vec<u32>,
    /// One half-edge for each edge.
    edges: Vec<u32>,
    outline: Outline,
}

impl Field {
    /// A field of corners in metres east, north and up, and triangles that all turn the same way. Corners at one place are made one;
    /// corners of no triangle are dropped.
    ///
    /// # Errors
    /// [`TerrainError::NotAHeightField`] with every fault's place, [`TerrainError::TooMany`].
    pub fn new(points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, TerrainError> {
        check::make(points, triangles, true)
    }

    /// The field as it is drawn: with every vertex where 32 bits put it. Horizons of anything else would be true of another surface.
    ///
    /// # Errors
    /// [`TerrainError::NotAHeightField`] where rounding turns triangles over or makes them empty.
    pub fn rounded(self) -> Result<Self, TerrainError> {
        let round = |point: &DVec3| point.as_vec3().as_dvec3();
        let same = |point: &DVec3| round(point) == *point;
        if self.points.iter().all(same) {
            return Ok(self);
        }
        let points = self.points.iter().map(round).collect();
        // About the same origin: what is moved may have to be rounded again.
        Self::about(self.origin, points, self.triangles)
    }

    /// As [`Field::new`], of corners that are relative to an origin already.
    pub(crate) fn about(
        origin: DVec3,
        points: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
    ) -> Result<Self, TerrainError> {
        let field = check::make(points, triangles, false)?;
        Ok(Self { origin, ..field })
    }

    /// Where the field's own coordinates begin: metres east, north and up.
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

    /// The border of the field, and whether it has gaps.
    #[must_use]
    pub fn outline(&self) -> &Outline {
        &self.outline
    }

    /// One half-edge for each edge.
    #[must_use]
    pub fn edges(&self) -> &[u32] {
        &self.edges
    }

    /// The half-edge that runs the other way; [`NONE`] at the border.
    #[must_use]
    pub fn across(&self, half: u32) -> u32 {
        self.across.get(half as usize).copied().unwrap_or(NONE)
    }

    /// The vertex that a half-edge leaves.
    #[must_use]
    pub fn start(&self, half: u32) -> u32 {
        let corners = &self.triangles[half as usize / 3];
        corners[half as usize % 3]
    }

    /// The vertex that a half-edge leads to.
    #[must_use]
    pub fn end(&self, half: u32) -> u32 {
        self.start(next(half))
    }

    /// A vertex, metres east, north and up of the origin.
    #[must_use]
    pub fn point(&self, vertex: u32) -> DVec3 {
        self.points[vertex as usize]
    }

    /// The corners of a triangle.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|vertex| self.point(vertex))
    }

    /// The two ends of an edge.
    #[must_use]
    pub fn ends(&self, half: u32) -> [DVec3; 2] {
        [self.point(self.start(half)), self.point(self.end(half))]
    }

    /// The smallest box around it in the plan.
    #[must_use]
    pub fn plan_bounds(&self) -> [DVec2; 2] {
        let plan = self.points.iter().map(|point| point.truncate());
        let empty = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        plan.fold(empty, |[low, high], at| [low.min(at), high.max(at)])
    }
}

/// The next side of the same triangle.
#[must_use]
pub fn next(half: u32) -> u32 {
    if half % 3 == 2 { half - 2 } else { half + 1 }
}

/// The side before it, of the same triangle.
#[must_use]
pub fn before(half: u32) -> u32 {
    if half.is_multiple_of(3) {
        half + 2
    } else {
        half - 1
    }
}
