//! Lines of sight over a field, judged by every edge that they cross: the truth that horizons are held against.
//!
//! Between two edges terrain and line of sight are both straight, so that a line is blocked exactly if it runs below an edge that it crosses.
//! Which side of an edge a line passes is decided with as many bits as it takes: Shewchuk, "Adaptive Precision Floating-Point Arithmetic and
//! Fast Robust Geometric Predicates", 1997.

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

    /// Whether terrain stands above the line between two places, metres east, north and up of the field's origin. Terrain that only
    /// touches the line does not, nor do edges that the line ends at.
    #[must_use]
    pub fn is_blocked(&self, from: DVec3, to: DVec3) -> bool {
        let plan = (to - from).truncate();
        let wanted = |extent: &Extent| is_crossed(extent, from.truncate(), plan);
        !self.boxes.all(wanted, |edge| {
            let [a, b] = self.field.ends(self.field.edges()[edge as usize]);
            let [left, right] = [a, b].map(|end| turn(from, to, end));
            let beside = left * right > 0.0 || left == right;
            if beside || turn(a, b, from) * turn(a, b, to) >= 0.0 {
                return true;
            }
            let [from, to, a, b] = [from, to, a, b].map(|at| robust::Coord3D {
                x: at.x,
                y: at.y,
                z: at.z,
            });
            let below = robust::orient3d(from, to, a, b);
            // The sign of what is below the edge, if the edge runs from the line's left to its right.
            let across = if left == 0.0 { -right } else { left };
            below * across.signum() >= 0.0
        })
    }
}

/// On which side of the line from one place to another a third lies in the plan: positive on its left, and never of the wrong sign.
fn turn(from: DVec3, to: DVec3, at: DVec3) -> f64 {
    let [from, to, at] = [from, to, at].map(|at| robust::Coord { x: at.x, y: at.y });
    robust::orient2d(from, to, at)
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
