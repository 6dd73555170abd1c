//! Equal boxes, told apart for the clustering that hierarchies are built by.

use std::collections::HashMap;

use glam::Vec3A;
use obvhs::aabb::Aabb as Box3;

/// The growth of a step, about two units in the last place of a coordinate near 1.
const STEP: f32 = 1.0 / (1 << 22) as f32;
/// How many sizes equal boxes get.
const SIZES: u32 = 16;

/// Grows each box that was there before by a tiny amount, of sixteen different ones.
///
/// Locally ordered clustering joins those pairs that are nearest to each other. Where a hundred thousand boxes are equal, each is nearest to the
/// one beside it, a single pair is joined in a round, and the time grows with the square. Coordinates are about 1 at most.
pub(crate) fn tell_apart(boxes: &mut [Box3]) {
    let mut known: HashMap<[u32; 6], u32> = HashMap::with_capacity(boxes.len());
    for one in boxes {
        let (min, max) = (one.min.to_array(), one.max.to_array());
        let [x, y, z] = min.map(f32::to_bits);
        let [u, v, w] = max.map(f32::to_bits);
        let before = known.entry([x, y, z, u, v, w]).or_default();
        if *before > 0 {
            // Multiplicative hashing (Knuth): neighbours get sizes far from each other.
            let size = before.wrapping_mul(0x9e37_79b9) >> (u32::BITS - SIZES.ilog2());
            let grown = Vec3A::splat((size + 1) as f32 * STEP);
            one.min -= grown;
            one.max += grown;
        }
        *before += 1;
    }
}
