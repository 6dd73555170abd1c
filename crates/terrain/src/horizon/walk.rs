//! A straight walk over the field, from a place on an edge to a place in the plan, edge by edge: Devillers, Pion, Teillaud, "Walking in a
//! Triangulation", 2002.

use glam::{DVec2, DVec3};

use super::crossing::Crossing;
use crate::field::{Field, NONE, before, next};

/// The most triangles of a walk. What lies farther away is no neighbour.
const MOST: u32 = 400;

/// Walks from a crossing to a place and calls for every place where an edge is crossed, and for the last one; `false` as soon as the
/// call says so, and where the way leaves the field.
pub(super) fn walk(
    field: &Field,
    from: Crossing,
    to: DVec2,
    mut step: impl FnMut(DVec3) -> bool,
) -> bool {
    let start = from.at.truncate();
    let way = to - start;
    if way == DVec2::ZERO {
        return true;
    }
    let side = |vertex: u32| way.perp_dot(field.point(vertex).truncate() - start);
    let mut half = from.half;
    let [a, b] = field.ends(half).map(DVec3::truncate);
    if (b - a).perp_dot(way) <= 0.0 {
        half = field.across(half);
    }
    for _ in 0..MOST {
        if half == NONE {
            return false;
        }
        let corners = [half, next(half), before(half)].map(|side| field.point(field.start(side)));
        let [a, b, c] = corners.map(DVec3::truncate);
        let inside = (c - b).perp_dot(to - b) >= 0.0 && (a - c).perp_dot(to - c) >= 0.0;
        if inside {
            return step(on_plane(corners, to));
        }
        let exit = if side(field.start(before(half))) >= 0.0 {
            next(half)
        } else {
            before(half)
        };
        let [p, q] = field.ends(exit);
        let [left, right] = [p, q].map(|end| way.perp_dot(end.truncate() - start));
        let share = if left == right {
            0.0
        } else {
            (left / (left - right)).clamp(0.0, 1.0)
        };
        if !step(p.lerp(q, share)) {
            return false;
        }
        half = field.across(exit);
    }
    false
}

/// The place of a triangle's plane above or below a place in the plan, kept between its corners.
fn on_plane([a, b, c]: [DVec3; 3], at: DVec2) -> DVec3 {
    let [p, q, r] = [a, b, c].map(DVec3::truncate);
    let shares = [
        (q - at).perp_dot(r - at),
        (r - at).perp_dot(p - at),
        (p - at).perp_dot(q - at),
    ]
    .map(|share| share.max(0.0));
    let whole: f64 = shares.iter().sum();
    (a * shares[0] + b * shares[1] + c * shares[2]) / whole
}
