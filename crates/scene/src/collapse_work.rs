//! How long edge collapses would take on a geometry.

use std::collections::HashMap;

use crate::mesh::Geometry;

/// Steps that are always allowed: a few seconds.
const MOST: u64 = 1 << 31;
/// Steps a vertex of an ordinary mesh, where six triangles share each vertex.
const USUAL: u64 = 64;

impl Geometry {
    /// Whether a simplifier by edge collapses ends in bounded time.
    ///
    /// For each edge it goes through all edges at the other end, so that its time grows with the sum of the squares of how many triangles
    /// share each position: a hundred thousand triangles at one point take a minute. An order for the vertex cache takes as long to find.
    #[must_use]
    pub fn is_collapsible(&self) -> bool {
        let mut shared: HashMap<[u32; 3], u64> = HashMap::with_capacity(self.positions.len());
        for index in &self.indices {
            if let Some(position) = self.positions.get(*index as usize) {
                *shared.entry(position.map(f32::to_bits)).or_default() += 1;
            }
        }
        let steps = shared.values().fold(0_u64, |sum, count| {
            sum.saturating_add(count.saturating_mul(*count))
        });
        steps <= MOST + USUAL * self.positions.len() as u64
    }
}
