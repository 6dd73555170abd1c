//! Where a line in the plan crosses an edge of the field. The edge is searched in f32; the crossing is computed in f64.

use glam::{DVec2, DVec3};

use crate::field::{Field, NONE, next};

/// A point on an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// The edge, as a half-edge.
    pub half_edge: u32,
    /// The point.
    pub at: DVec3,
}

/// Where the ray from a position along a direction crosses an edge. `None` if it does not.
fn cross(field: &Field, from: DVec3, direction: DVec2, half_edge: u32) -> Option<Crossing> {
    let [a, b] = field.ends(half_edge);
    let [left, right] = [a, b].map(|end| direction.perp_dot((end - from).truncate()));
    if left * right > 0.0 || left == right {
        return None;
    }
    let at = a.lerp(b, left / (left - right));
    let ahead = direction.dot((at - from).truncate()) > 0.0;
    ahead.then_some(Crossing { half_edge, at })
}

/// As [`cross`], for an edge that a search in f32 found. If the ray passes just beside it, the crossing is on another edge around its
/// nearer end.
pub(super) fn resolve(
    field: &Field,
    from: DVec3,
    direction: DVec2,
    half_edge: u32,
) -> Option<Crossing> {
    if half_edge == NONE {
        return None;
    }
    cross(field, from, direction, half_edge).or_else(|| {
        let [a, b] = field.ends(half_edge);
        let [left, right] = [a, b].map(|end| direction.perp_dot((end - from).truncate()).abs());
        let start = if left <= right {
            half_edge
        } else {
            next(half_edge)
        };
        let edges = field.edges_around_start(start);
        edges
            .into_iter()
            .find_map(|edge| cross(field, from, direction, edge))
    })
}

/// The slope of the line from one position to another: metres up for each metre in the plan.
pub(super) fn slope(from: DVec3, to: DVec3) -> f64 {
    (to.z - from.z) / (to - from).truncate().length()
}
