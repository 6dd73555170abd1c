//! Triangulation of polygons with holes by ear clipping (David Eberly; the crate `earcut`, after Mapbox), in a
//! projection along the axis nearest to the normal. The normal is Newell's (Martin Newell, in Sutherland, Sproull and
//! Schumacker, 1974). A polygon that its first corner sees whole, such as a convex one, becomes a fan.

use crate::budget::Budget;
use crate::error::LoadProblem;
use antumbra_scene::Geometry;
use earcut::Earcut;
use glam::{DVec2, DVec3};

/// Buffers for triangulation, reused for every surface.
pub(crate) struct Triangulator {
    earcut: Earcut<f64>,
    corners: Vec<DVec3>,
    flat: Vec<[f64; 2]>,
    holes: Vec<u32>,
    /// Whether the outer ring encloses no area. Its holes are then ignored.
    is_void: bool,
    triangles: Vec<u32>,
}

/// The greatest number of corners of a surface that is cut. The time of ear clipping grows with their square where rings
/// intersect; at this number it is seconds.
pub(crate) const MAX_CORNERS: usize = 1 << 13;

/// A polygon of at most this many corners is cut in no time that counts.
const FEW_CORNERS: usize = 64;

/// A surface whose area is below this fraction of the square of its extent counts as a line.
const MIN_AREA: f64 = 1e-12;

impl Triangulator {
    pub(crate) fn new() -> Self {
        Self {
            earcut: Earcut::new(),
            corners: Vec::new(),
            flat: Vec::new(),
            holes: Vec::new(),
            is_void: false,
            triangles: Vec::new(),
        }
    }

    /// Starts a new surface.
    pub(crate) fn clear(&mut self) {
        self.corners.clear();
        self.holes.clear();
        self.is_void = false;
    }

    /// Adds a ring to the surface, the outer one first. A ring that encloses no area is ignored.
    pub(crate) fn ring(&mut self, corners: impl IntoIterator<Item = DVec3>) {
        if self.is_void {
            return;
        }
        let start = self.corners.len();
        self.corners.extend(corners);
        if self.corners.len() - start < 3 {
            self.corners.truncate(start);
            self.is_void |= start == 0;
        } else if start > 0 {
            self.holes.push(start as u32);
        }
    }

    /// Appends the surface's vertices, normals and triangles. Returns the number of triangles, 0 for a surface
    /// without an area.
    ///
    /// # Errors
    /// Work that exceeds the budget.
    pub(crate) fn finish(
        &mut self,
        geometry: &mut Geometry,
        budget: &mut Budget,
    ) -> Result<u64, LoadProblem> {
        let Some(normal) = self.cut(budget)? else {
            return Ok(0);
        };
        let first = geometry.positions.len() as u32;
        let positions = self
            .corners
            .iter()
            .map(|corner| corner.as_vec3().to_array());
        geometry.positions.extend(positions);
        let normals = std::iter::repeat_n(normal.as_vec3().to_array(), self.corners.len());
        geometry.normals.extend(normals);
        let corners = self.triangles.iter().map(|corner| first + corner);
        geometry.indices.extend(corners);
        Ok((self.triangles.len() / 3) as u64)
    }

    /// The triangles of one ring, as numbers of its corners, counter-clockwise about the ring's normal. A ring without an area becomes a fan,
    /// which shows as little as the ring. `None` for a ring of more than [`MAX_CORNERS`] corners, which is not cut.
    ///
    /// # Errors
    /// Work that exceeds the budget.
    pub(crate) fn polygon(
        &mut self,
        corners: impl IntoIterator<Item = DVec3>,
        budget: &mut Budget,
    ) -> Result<Option<&[[u32; 3]]>, LoadProblem> {
        self.clear();
        // One more tells that there are too many.
        (self.corners).extend(corners.into_iter().take(MAX_CORNERS + 1));
        let count = self.corners.len();
        if count > MAX_CORNERS {
            return Ok(None);
        }
        if count == 3 || !self.is_fan() && self.cut(budget)?.is_none() {
            self.fan();
        }
        Ok(Some(self.triangles.as_chunks::<3>().0))
    }

    /// Whether the first corner sees the whole ring; the triangles are then a fan. Unlike ear clipping it keeps corners within edges, at which
    /// neighbours may have a corner.
    fn is_fan(&mut self) -> bool {
        let Some(normal) = normal(&self.corners) else {
            return false;
        };
        self.flatten(normal);
        self.fan();
        let triangles = self.triangles.as_chunks::<3>().0;
        !triangles
            .iter()
            .any(|triangle| self.is_clockwise(*triangle))
    }

    /// Cuts the surface into triangles, counter-clockwise about its normal, which is returned; `None` if it has no area.
    ///
    /// # Errors
    /// Work that exceeds the budget.
    fn cut(&mut self, budget: &mut Budget) -> Result<Option<DVec3>, LoadProblem> {
        let outer = self
            .holes
            .first()
            .map_or(self.corners.len(), |hole| *hole as usize);
        let Some(normal) = self.corners.get(..outer).and_then(normal) else {
            return Ok(None);
        };
        let count = self.corners.len();
        if count > FEW_CORNERS {
            budget.work((count as u64).saturating_pow(2) / FEW_CORNERS as u64)?;
        }
        self.flatten(normal);
        self.earcut
            .earcut_slice(&self.flat, &self.holes, &mut self.triangles);
        let mut triangles = std::mem::take(&mut self.triangles);
        for triangle in triangles.as_chunks_mut::<3>().0 {
            if self.is_clockwise(*triangle) {
                triangle.swap(1, 2);
            }
        }
        self.triangles = triangles;
        Ok((!self.triangles.is_empty()).then_some(normal))
    }

    /// Projects the corners.
    fn flatten(&mut self, normal: DVec3) {
        self.flat.clear();
        let corners = self.corners.iter();
        self.flat
            .extend(corners.map(|corner| along(normal, *corner).to_array()));
    }

    /// Triangles from the first corner to all others.
    fn fan(&mut self) {
        self.triangles.clear();
        for last in 2..self.corners.len() as u32 {
            self.triangles.extend([0, last - 1, last]);
        }
    }

    fn is_clockwise(&self, triangle: [u32; 3]) -> bool {
        let [a, b, c] = triangle.map(|corner| {
            let corner = self.flat.get(corner as usize).copied();
            DVec2::from_array(corner.unwrap_or_default())
        });
        (b - a).perp_dot(c - a) < 0.0
    }
}

/// The unit normal of a ring, which may be neither flat nor convex. The ring runs counter-clockwise about it. `None`
/// for a ring that encloses no area.
fn normal(ring: &[DVec3]) -> Option<DVec3> {
    let origin = *ring.first()?;
    let (mut sum, mut extent) = (DVec3::ZERO, 0.0_f64);
    let mut before = ring.last()? - origin;
    for corner in ring {
        let corner = corner - origin;
        sum += before.cross(corner);
        extent = extent.max(corner.length_squared());
        before = corner;
    }
    (sum.length() > extent * MIN_AREA).then(|| sum.normalize())
}

/// Projects a point along the axis nearest to the normal. What runs counter-clockwise about the normal does so in the
/// projection.
fn along(normal: DVec3, point: DVec3) -> DVec2 {
    let size = normal.abs();
    let (flat, towards) = if size.x >= size.y && size.x >= size.z {
        (DVec2::new(point.y, point.z), normal.x)
    } else if size.y >= size.z {
        (DVec2::new(point.z, point.x), normal.y)
    } else {
        (DVec2::new(point.x, point.y), normal.z)
    };
    if towards < 0.0 {
        DVec2::new(flat.y, flat.x)
    } else {
        flat
    }
}
