//! Seismic volumes: samples on a regular grid, in bricks.

mod axis;
mod brick_cache;
mod colour_map;
mod file_format;
mod layout;
mod sample_box;
mod source;
mod volume_file;
mod write;

pub use axis::Axis;
pub use brick_cache::{BrickCache, BrickCacheStats};
pub use colour_map::ColourMap;
pub(crate) use colour_map::{UNKNOWN, amplitudes};
#[cfg(feature = "read")]
pub(crate) use file_format::{brick_offset, encode as encode_header};
pub use layout::VolumeLayout;
pub use sample_box::SampleBox;
pub use source::BrickSource;
pub use volume_file::VolumeFile;
pub use write::write_volume;
