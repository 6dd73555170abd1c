//! A straight walk over the field, edge by edge: Devillers, Pion, Teillaud, "Walking in a Triangulation", 2002.

use glam::{DVec2, DVec3};

use super::crossing::Crossing;
use crate::field::{Field, NONE, next, prev};

/// The most triangles of a walk. A longer walk is given up.
const MOST: u32 = 400;

/// Walks from a crossing to a position in the plan. Calls `step` for the point of every edge that is crossed, and for the last point.
/// Returns whether the walk arrived: `false` as soon as `step` returns `false`, or where the walk leaves the field.
pub(super) fn walk(
    field: &Field,
    from: Crossing,
    to: DVec2,
    mut step: impl FnMut(DVec3) -> bool,
) -> bool {
    let start = from.at.truncate();
    let direction = to - start;
    if direction == DVec2::ZERO {
        return true;
    }
    let side = |vertex: u32| direction.perp_dot(field.point(vertex).truncate() - start);
    let mut half_edge = from.half_edge;
    let [a, b] = field.ends(half_edge).map(DVec3::truncate);
    if (b - a).perp_dot(direction) <= 0.0 {
        half_edge = field.opposite(half_edge);
    }
    for _ in 0..MOST {
        if half_edge == NONE {
            return false;
        }
        let corners = [half_edge, next(half_edge), prev(half_edge)]
            .map(|side| field.point(field.start(side)));
        let [a, b, c] = corners.map(DVec3::truncate);
        let inside = (c - b).perp_dot(to - b) >= 0.0 && (a - c).perp_dot(to - c) >= 0.0;
        if inside {
            return step(on_plane(corners, to));
        }
        let exit = if side(field.start(prev(half_edge))) >= 0.0 {
            next(half_edge)
        } else {
            prev(half_edge)
        };
        let [p, q] = field.ends(exit);
        let [left, right] = [p, q].map(|end| direction.perp_dot(end.truncate() - start));
        let share = if left == right {
            0.0
        } else {
            (left / (left - right)).clamp(0.0, 1.0)
        };
        if !step(p.lerp(q, share)) {
            return false;
        }
        half_edge = field.opposite(exit);
    }
    false
}

/// The point of a triangle above a position in the plan. A position outside is moved to the triangle.
fn on_plane([a, b, c]: [DVec3; 3], at: DVec2) -> DVec3 {
    let [p, q, r] = [a, b, c].map(DVec3::truncate);
    let weights = [
        (q - at).perp_dot(r - at),
        (r - at).perp_dot(p - at),
        (p - at).perp_dot(q - at),
    ]
    .map(|weight| weight.max(0.0));
    let total: f64 = weights.iter().sum();
    (a * weights[0] + b * weights[1] + c * weights[2]) / total
}
