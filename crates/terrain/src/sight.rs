//! Lines of sight over a field, judged by every edge that they cross: the truth that horizons are held against.
//!
//! Between two edges terrain and line of sight are both straight, so that a line is blocked exactly if it runs below an edge that it crosses.
//! Heights are compared with 64 bits; a line that touches an edge to within a billionth of its length counts as free.

use glam::{DVec2, DVec3};

use crate::field::Field;
use crate::packed::{Boxes, Extent};

/// Answers who sees whom over a field.
#[derive(Debug, Clone)]
pub struct Sights<'a> {
    field: &'a Field,
    boxes: Boxes,
}

impl<'a> Sights<'a> {
    /// For the field.
    #[must_use]
    pub fn new(field: &'a Field) -> Self {
        let extents = field
            .edges()
            .iter()
            .map(|&half| Extent::around(field.ends(half).map(DVec3::truncate)));
        Self {
            field,
            boxes: Boxes::new(extents.collect()),
        }
    }

    /// Whether terrain stands above the line between two places, metres east, north and up of the field's origin. Edges that the line ends at do not count.
    #[must_use]
    pub fn is_blocked(&self, from: DVec3, to: DVec3) -> bool {
        let way = to - from;
        let plan = way.truncate();
        let wanted = |extent: &Extent| is_crossed(extent, from.truncate(), plan);
        !self.boxes.all(wanted, |edge| {
            let [a, b] = self.field.ends(self.field.edges()[edge as usize]);
            let [left, right] = [a, b].map(|end| plan.perp_dot((end - from).truncate()));
            if left * right > 0.0 || left == right {
                return true;
            }
            let at = a.lerp(b, left / (left - right));
            let along = plan.dot((at - from).truncate()) / plan.length_squared();
            let slack = 1e-9;
            let between = along > slack && along < 1.0 - slack;
            !(between && at.z > from.z + way.z * along + slack * plan.length())
        })
    }
}

/// Whether a line from a place meets a box.
fn is_crossed(extent: &Extent, from: DVec2, way: DVec2) -> bool {
    let line = Extent::around([from, from + way]);
    if !line.touches(extent) {
        return false;
    }
    let middle = (extent.low + extent.high) / 2.0 - from;
    let half = (extent.high - extent.low) / 2.0;
    let reach = way.x.abs() * half.y + way.y.abs() * half.x;
    // A little more than it takes, for what is lost in rounding.
    way.perp_dot(middle).abs() <= reach * (1.0 + 1e-9) + way.length_squared() * 1e-12
}
