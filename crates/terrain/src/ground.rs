//! Where the surface is: the height below a place, and whether anything of the surface is near one.

use glam::{DVec2, DVec3};

use crate::field::Field;
use crate::packed::{Boxes, Extent};

/// Finds a field's triangles by place. The field is named anew in every question, so that one can own both.
#[derive(Debug, Clone)]
pub struct Ground {
    boxes: Boxes,
}

impl Ground {
    /// Of a field.
    #[must_use]
    pub fn new(field: &Field) -> Self {
        let extents = (0..field.triangles().len() as u32)
            .map(|triangle| Extent::around(field.corners(triangle).map(DVec3::truncate)));
        Self {
            boxes: Boxes::new(extents.collect()),
        }
    }

    /// The triangle over a place in the plan, and its height there, metres; `None` outside of the field and in its holes.
    #[must_use]
    pub fn below(&self, field: &Field, place: DVec2) -> Option<(u32, f64)> {
        let mut found = None;
        self.boxes.all(
            |extent| extent.touches(&Extent::around([place])),
            |triangle| {
                found = height_of(field, triangle, place).map(|height| (triangle, height));
                found.is_none()
            },
        );
        found
    }

    /// Whether the field has a triangle with just these corners, counter-clockwise from any of them.
    #[must_use]
    pub fn has(&self, field: &Field, [a, b, c]: &[DVec3; 3]) -> bool {
        let turns = [[*a, *b, *c], [*b, *c, *a], [*c, *a, *b]];
        let extent = Extent::around([a, b, c].map(|corner| corner.truncate()));
        !self.boxes.all(
            |own| own.touches(&extent),
            |triangle| !turns.contains(&field.corners(triangle)),
        )
    }

    /// The highest place of the triangles that reach within so many metres of a place in the plan; no higher than what of them does.
    #[must_use]
    pub fn highest_near(&self, field: &Field, place: DVec2, reach: f64) -> Option<f64> {
        let square = Extent {
            low: place - reach,
            high: place + reach,
        };
        let mut highest: Option<f64> = None;
        self.boxes.each_touching(&square, |triangle| {
            let [a, b, c] = field.corners(triangle);
            // Its box may touch the square where it does not itself: all of the square lies beyond one of its sides then.
            let beyond = |[a, b]: [DVec3; 2]| {
                let side = (b - a).truncate();
                let inward = side.perp_dot(place - a.truncate());
                inward + side.abs().element_sum() * reach < -1e-9 * side.length_squared()
            };
            if [[a, b], [b, c], [c, a]].into_iter().any(beyond) {
                return;
            }
            let normal = (b - a).cross(c - a);
            let fall = -normal.truncate() / normal.z;
            // The plane over the square's highest corner, and no more than the triangle's own.
            let plane = a.z + fall.dot(place - a.truncate()) + fall.abs().element_sum() * reach;
            let top = plane.min(a.z.max(b.z).max(c.z));
            highest = Some(highest.map_or(top, |highest| highest.max(top)));
        });
        highest
    }
}

/// The height of a triangle at a place in it.
fn height_of(field: &Field, triangle: u32, place: DVec2) -> Option<f64> {
    let corners = field.corners(triangle);
    let [a, b, c] = corners.map(|corner| corner.truncate() - place);
    let shares = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
    let inside = shares.iter().all(|share| *share >= 0.0);
    let whole: f64 = shares.iter().sum();
    let heights = corners
        .iter()
        .zip(shares)
        .map(|(corner, share)| corner.z * share);
    inside.then(|| heights.sum::<f64>() / whole)
}
