//! Queries about the surface of a field: its height at a position, and the highest point near a position.

use glam::{DVec2, DVec3};

use crate::field::Field;
use crate::packed_tree::{Extent, PackedTree};

/// A spatial index of a field's triangles in the plan. Every query takes the field as well, so that one struct can own both.
#[derive(Debug, Clone)]
pub struct Ground {
    tree: PackedTree,
}

/// A point of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// The triangle that it lies in.
    pub triangle: u32,
    /// Its height, metres up of the field's origin.
    pub height: f64,
}

impl Ground {
    /// Indexes the triangles of a field.
    #[must_use]
    pub fn new(field: &Field) -> Self {
        let extents: Vec<Extent> = (0..field.triangles().len() as u32)
            .map(|triangle| Extent::around(field.corners(triangle).map(DVec3::truncate)))
            .collect();
        Self {
            tree: PackedTree::new(&extents),
        }
    }

    /// The surface at a position in the plan, metres from the field's origin. `None` outside of the field and in its holes.
    #[must_use]
    pub fn surface_at(&self, field: &Field, at: DVec2) -> Option<SurfacePoint> {
        let mut found = None;
        self.tree.each_while(
            |extent| extent.touches(&Extent::around([at])),
            |triangle| {
                let height = height_in(field, triangle, at);
                found = height.map(|height| SurfacePoint { triangle, height });
                found.is_none()
            },
        );
        found
    }

    /// Whether the field has a triangle with these corners, counter-clockwise from any of them.
    #[must_use]
    pub fn has_triangle(&self, field: &Field, [a, b, c]: &[DVec3; 3]) -> bool {
        let rotations = [[*a, *b, *c], [*b, *c, *a], [*c, *a, *b]];
        let extent = Extent::around([a, b, c].map(|corner| corner.truncate()));
        !self.tree.each_while(
            |own| own.touches(&extent),
            |triangle| !rotations.contains(&field.corners(triangle)),
        )
    }

    /// An upper bound of the surface's height within the square that reaches `reach` metres from a position in the plan, in each axis.
    /// `None` where no triangle touches that square. The bound is the height of the triangles' planes over the square, or of their highest
    /// corners where those are lower.
    #[must_use]
    pub fn highest_near(&self, field: &Field, at: DVec2, reach: f64) -> Option<f64> {
        let square = Extent {
            low: at - reach,
            high: at + reach,
        };
        let mut highest: Option<f64> = None;
        self.tree.each_touching(&square, |triangle| {
            let [a, b, c] = field.corners(triangle);
            // The triangle's box may touch the square when the triangle does not. Then the whole square lies beyond one of its sides.
            let beyond = |[a, b]: [DVec3; 2]| {
                let side = (b - a).truncate();
                let inward = side.perp_dot(at - a.truncate());
                inward + side.abs().element_sum() * reach < -1e-9 * side.length_squared()
            };
            if [[a, b], [b, c], [c, a]].into_iter().any(beyond) {
                return;
            }
            let normal = (b - a).cross(c - a);
            let gradient = -normal.truncate() / normal.z;
            // The plane at the corner of the square where it is highest, and no higher than the triangle itself.
            let plane =
                a.z + gradient.dot(at - a.truncate()) + gradient.abs().element_sum() * reach;
            let top = plane.min(a.z.max(b.z).max(c.z));
            highest = Some(highest.map_or(top, |highest| highest.max(top)));
        });
        highest
    }
}

/// The height of a triangle at a position within it; `None` outside of the triangle.
fn height_in(field: &Field, triangle: u32, at: DVec2) -> Option<f64> {
    let corners = field.corners(triangle);
    let [a, b, c] = corners.map(|corner| corner.truncate() - at);
    let weights = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
    let inside = weights.iter().all(|weight| *weight >= 0.0);
    let total: f64 = weights.iter().sum();
    let heights = corners
        .iter()
        .zip(weights)
        .map(|(corner, weight)| corner.z * weight);
    inside.then(|| heights.sum::<f64>() / total)
}
