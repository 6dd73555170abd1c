//! The boundary of a field. Nothing is known of what lies beyond it, and nothing of what lies in a hole.

use glam::DVec2;
use robust::{Coord, orient2d};

use super::half_edge::{NONE, next};

/// The boundary of a field: its outer borders and its holes.
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    /// Closed rings of the half-edges without an opposite. The field is on the left of each: outer borders run counter-clockwise, holes
    /// clockwise.
    pub rings: Vec<Vec<u32>>,
    /// Whether the boundary is one convex ring. Then the straight line between any two points of the field stays over the field, and only
    /// then does every line of sight that dips below the surface come up through it again.
    pub convex: bool,
}

/// Finds the rings. `opposite` has the opposite of each half-edge, `start` returns the vertex that a half-edge starts at, and `plan` a
/// vertex's position in the plan.
pub(super) fn boundary(
    opposite: &[u32],
    start: impl Fn(u32) -> u32,
    plan: impl Fn(u32) -> DVec2,
) -> Boundary {
    let mut done = vec![false; opposite.len()];
    let mut rings = Vec::new();
    for half_edge in 0..opposite.len() as u32 {
        if opposite[half_edge as usize] != NONE || done[half_edge as usize] {
            continue;
        }
        let mut ring = Vec::new();
        let mut at = half_edge;
        while !done[at as usize] {
            done[at as usize] = true;
            ring.push(at);
            at = next_on_boundary(at, opposite);
        }
        rings.push(ring);
    }
    let convex = match rings.as_slice() {
        [ring] => is_convex(
            ring.iter()
                .map(|&half_edge| plan(start(half_edge)))
                .collect(),
        ),
        _ => false,
    };
    Boundary { rings, convex }
}

/// The boundary half-edge that starts where this one ends, found by walking from triangle to triangle around that vertex.
fn next_on_boundary(half_edge: u32, opposite: &[u32]) -> u32 {
    let mut at = next(half_edge);
    while opposite[at as usize] != NONE {
        at = next(opposite[at as usize]);
    }
    at
}

fn is_convex(ring: Vec<DVec2>) -> bool {
    let coord = |at: DVec2| Coord { x: at.x, y: at.y };
    let corners = ring.len();
    (0..corners).all(|i| {
        let [a, b, c] = [0, 1, 2].map(|step| coord(ring[(i + step) % corners]));
        orient2d(a, b, c) >= 0.0
    })
}
