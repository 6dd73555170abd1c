//! Where a line in the plan crosses an edge of the field: found with 32 bits, told with 64.

use glam::{DVec2, DVec3};

use crate::field::around;
use crate::field::{Field, NONE};

/// A place on an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// The edge.
    pub half: u32,
    /// The place.
    pub at: DVec3,
}

/// Where the line from a place in a direction crosses an edge; `None` where it does not, or behind it.
fn cross(field: &Field, from: DVec3, way: DVec2, half: u32) -> Option<Crossing> {
    let [a, b] = field.ends(half);
    let [left, right] = [a, b].map(|end| way.perp_dot((end - from).truncate()));
    if left * right > 0.0 || left == right {
        return None;
    }
    let at = a.lerp(b, left / (left - right));
    let ahead = way.dot((at - from).truncate()) > 0.0;
    ahead.then_some(Crossing { half, at })
}

/// The same for the edge that a search with fewer bits chose: where the line passes just beside it, the next edge around its nearer end.
pub(super) fn resolve(field: &Field, from: DVec3, way: DVec2, half: u32) -> Option<Crossing> {
    if half == NONE {
        return None;
    }
    cross(field, from, way, half).or_else(|| {
        let [a, b] = field.ends(half);
        let [left, right] = [a, b].map(|end| way.perp_dot((end - from).truncate()).abs());
        let out = if left <= right {
            half
        } else {
            crate::field::next(half)
        };
        let spokes = around(field, out);
        spokes
            .into_iter()
            .find_map(|spoke| cross(field, from, way, spoke))
    })
}

/// How steeply the line from one place to another rises.
pub(super) fn slope(from: DVec3, to: DVec3) -> f64 {
    (to.z - from.z) / (to - from).truncate().length()
}
