//! The boxes of a mesh's parts as the device tests them.

use antumbra_scene::PartBox;
use bytemuck::{Pod, Zeroable};

/// A part's box, 8 bytes. Mirrors `shared/part_box.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct GpuPartBox {
    /// Ten bits for each axis: where it begins. The upper two: the lower bits of how many parts follow in the mesh.
    low: u32,
    /// Where it ends, and the upper bits of that number.
    high: u32,
}

impl GpuPartBox {
    /// The most boxes of a mesh.
    pub const MOST: usize = 16;
    /// So many places of first parts can be told apart: bits 8 and up of the traits of a [`JudgedInstance`](crate::judge::JudgedInstance) hold one.
    pub(super) const PLACES: u32 = 1 << 24;

    /// Those of a mesh, at most [`Self::MOST`].
    pub(super) fn of(boxes: &[PartBox]) -> impl Iterator<Item = Self> + '_ {
        let following = (0..boxes.len() as u32).rev();
        boxes.iter().zip(following).map(|(part, following)| {
            let pack = |[x, y, z]: [u16; 3]| u32::from(x) | u32::from(y) << 10 | u32::from(z) << 20;
            Self {
                low: pack(part.low) | (following & 3) << 30,
                high: pack(part.high) | following >> 2 << 30,
            }
        })
    }
}
