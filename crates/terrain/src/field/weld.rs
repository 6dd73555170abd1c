//! Welding: vertices at the same position become one. Files repeat a vertex where its normal or its texture coordinates change.

use glam::DVec3;

use crate::fault::FieldFault;

/// What welding found.
pub(super) struct Welded {
    /// For each vertex, the vertex that replaces it.
    pub replacements: Vec<u32>,
    /// Positions in the plan that have two heights.
    pub faults: Vec<FieldFault>,
}

/// Welds the vertices that are `used` by a triangle.
pub(super) fn weld(points: &[DVec3], used: &[bool]) -> Welded {
    let mut replacements: Vec<u32> = (0..points.len() as u32).collect();
    let mut order: Vec<u32> = replacements.clone();
    order.retain(|&vertex| used[vertex as usize]);
    // Adding zero turns -0.0 into 0.0: both are the same position.
    let position = |vertex: u32| points[vertex as usize] + DVec3::ZERO;
    order.sort_unstable_by(|&a, &b| {
        let (p, q) = (position(a), position(b));
        p.x.total_cmp(&q.x)
            .then(p.y.total_cmp(&q.y))
            .then(p.z.total_cmp(&q.z))
            .then(a.cmp(&b))
    });
    let mut faults = Vec::new();
    for pair in order.windows(2) {
        let [first, second] = [pair[0], pair[1]];
        let (p, q) = (position(first), position(second));
        if p == q {
            replacements[second as usize] = replacements[first as usize];
        } else if p.truncate() == q.truncate() {
            faults.push(FieldFault::TwoHeights { at: p, other: q.z });
        }
    }
    Welded {
        replacements,
        faults,
    }
}
