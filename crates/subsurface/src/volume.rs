//! Seismic volumes: samples on a regular grid, in bricks.

use glam::DVec3;

use crate::error::SubsurfaceError;

/// How large a volume is, where it lies, and what its samples mean.
///
/// A sample is a byte: 0 where nothing is known, else 1..=255 from the lower to the upper end of `range`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumeLayout {
    /// Samples along the inline, crossline and time (or depth) axis.
    pub size: [u32; 3],
    /// Samples along an edge of a brick.
    pub brick: u32,
    /// Where sample (0, 0, 0) lies in the world, in metres.
    pub origin: DVec3,
    /// The way to the next sample along each axis, in metres.
    pub steps: [DVec3; 3],
    /// The values that 1 and 255 stand for.
    pub range: [f32; 2],
}

impl VolumeLayout {
    /// Bricks along each axis.
    #[must_use]
    pub fn bricks(&self) -> [u32; 3] {
        self.size.map(|side| side.div_ceil(self.brick.max(1)))
    }

    /// Samples, and bytes, of a brick.
    #[must_use]
    pub fn brick_bytes(&self) -> usize {
        (self.brick as usize).pow(3)
    }
}

/// Where bricks come from: a file, or a rule.
pub trait BrickSource: Send + Sync {
    /// The volume's layout.
    fn layout(&self) -> &VolumeLayout;

    /// Fills `samples` ([`VolumeLayout::brick_bytes`] long) with a brick, the inline axis fastest, then crossline, then time. Places beyond the
    /// volume's end repeat its last samples.
    ///
    /// # Errors
    /// When there is no such brick, or it cannot be read.
    fn read(&self, brick: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError>;
}
