//! The source of a volume's bricks.

use super::layout::VolumeLayout;
use crate::error::SubsurfaceError;

/// A source of bricks: a file, or a function of position.
pub trait BrickSource: Send + Sync {
    /// The volume's layout.
    fn layout(&self) -> &VolumeLayout;

    /// Fills `samples` ([`VolumeLayout::brick_bytes`] long) with a brick, the inline axis fastest, then crossline,
    /// then time. Samples beyond the volume's end repeat its last samples.
    ///
    /// # Errors
    /// If there is no such brick, or it cannot be read.
    fn read(&self, brick: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError>;
}
