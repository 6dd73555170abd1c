//! Exact line-of-sight tests over a field: the reference that horizons are compared with.
//!
//! Between two edges both the terrain and the line are straight. So a line is blocked exactly if it runs below an edge that it crosses. The
//! side of an edge that a line passes on is decided with as many bits as that takes: Shewchuk, "Adaptive Precision Floating-Point Arithmetic
//! and Fast Robust Geometric Predicates", 1997.

use glam::{DVec2, DVec3};

use crate::field::Field;
use crate::packed_tree::{Extent, PackedTree};

/// Tests lines of sight over a field.
#[derive(Debug, Clone)]
pub struct LineOfSight<'a> {
    field: &'a Field,
    tree: PackedTree,
}

impl<'a> LineOfSight<'a> {
    /// Indexes the edges of a field.
    #[must_use]
    pub fn new(field: &'a Field) -> Self {
        let extents: Vec<Extent> = field
            .edges()
            .iter()
            .map(|&half_edge| Extent::around(field.ends(half_edge).map(DVec3::truncate)))
            .collect();
        Self {
            field,
            tree: PackedTree::new(&extents),
        }
    }

    /// Whether terrain rises above the line between two positions, metres east, north and up of the field's origin. Terrain that only
    /// touches the line does not block it, nor does an edge that the line ends at.
    #[must_use]
    pub fn is_blocked(&self, from: DVec3, to: DVec3) -> bool {
        let plan = (to - from).truncate();
        let wanted = |extent: &Extent| is_crossed(extent, from.truncate(), plan);
        !self.tree.each_while(wanted, |edge| {
            let [a, b] = self.field.ends(self.field.edges()[edge as usize]);
            let [left, right] = [a, b].map(|end| side_of(from, to, end));
            let beside = left * right > 0.0 || left == right;
            if beside || side_of(a, b, from) * side_of(a, b, to) >= 0.0 {
                return true;
            }
            let [from, to, a, b] = [from, to, a, b].map(|at| robust::Coord3D {
                x: at.x,
                y: at.y,
                z: at.z,
            });
            let below = robust::orient3d(from, to, a, b);
            // `below` is negative for a line below an edge that runs from the line's left to its right. `across` has that direction's sign.
            let across = if left == 0.0 { -right } else { left };
            below * across.signum() >= 0.0
        })
    }
}

/// The side of the line between two positions that a third one lies on, in the plan: positive on the left. The sign is exact.
fn side_of(from: DVec3, to: DVec3, at: DVec3) -> f64 {
    let [from, to, at] = [from, to, at].map(|at| robust::Coord { x: at.x, y: at.y });
    robust::orient2d(from, to, at)
}

/// Whether the line from a position along `direction`, as long as that, may cross a box. It may return `true` for a line just beside.
fn is_crossed(extent: &Extent, from: DVec2, direction: DVec2) -> bool {
    let line = Extent::around([from, from + direction]);
    if !line.touches(extent) {
        return false;
    }
    let middle = (extent.low + extent.high) / 2.0 - from;
    let half = (extent.high - extent.low) / 2.0;
    let reach = direction.x.abs() * half.y + direction.y.abs() * half.x;
    // A margin for rounding.
    direction.perp_dot(middle).abs() <= reach * (1.0 + 1e-9) + direction.length_squared() * 1e-12
}
