//! The border of a field: what lies beyond it is unknown, and so are its holes.

use glam::DVec2;
use robust::{Coord, orient2d};

use super::{Field, NONE, before};

/// What a field's border looks like.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Closed rings of half-edges without a counterpart, the field on their left: outer borders run counter-clockwise, holes clockwise.
    pub rings: Vec<Vec<u32>>,
    /// Whether a straight line between any two places of the field stays within it: one ring, and that one convex. Only then does every
    /// line of sight that dips below the surface come up through it again.
    pub whole: bool,
}

/// Finds the rings. `start` says which vertex a half-edge leaves.
pub(super) fn outline(
    across: &[u32],
    start: impl Fn(u32) -> u32,
    plan: impl Fn(u32) -> DVec2,
) -> Outline {
    let mut done = vec![false; across.len()];
    let mut rings = Vec::new();
    for half in 0..across.len() as u32 {
        if across[half as usize] != NONE || done[half as usize] {
            continue;
        }
        let mut ring = Vec::new();
        let mut at = half;
        while !done[at as usize] {
            done[at as usize] = true;
            ring.push(at);
            at = following(at, across);
        }
        rings.push(ring);
    }
    let whole = match rings.as_slice() {
        [ring] => is_convex(ring.iter().map(|&half| plan(start(half))).collect()),
        _ => false,
    };
    Outline { rings, whole }
}

/// The border's next half-edge: around the end of this one, from triangle to triangle.
fn following(half: u32, across: &[u32]) -> u32 {
    let mut at = super::next(half);
    while across[at as usize] != NONE {
        at = super::next(across[at as usize]);
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

/// The edges at the vertex that a half-edge leaves, as half-edges of either way.
pub(crate) fn around(field: &Field, half: u32) -> Vec<u32> {
    let mut edges = vec![half];
    let mut at = half;
    loop {
        // Counter-clockwise: the side that leads back to the vertex, seen from the other triangle, leaves it.
        let back = before(at);
        edges.push(back);
        at = field.across(back);
        if at == half {
            return edges;
        }
        if at == NONE {
            break;
        }
    }
    // A border kept the walk from coming round: clockwise from the first.
    let mut at = field.across(half);
    while at != NONE {
        let out = super::next(at);
        edges.push(out);
        at = field.across(out);
    }
    edges
}
