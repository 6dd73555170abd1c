//! Positions as keys of maps and sets.

use glam::DVec3;

/// A key that is equal for positions that are equal bit for bit. Adding zero turns -0.0 into 0.0.
pub(crate) fn position_key(position: DVec3) -> [u64; 3] {
    (position + DVec3::ZERO).to_array().map(f64::to_bits)
}
