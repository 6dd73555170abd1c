//! The occupancy map: which parts of the screen have been drawn to, a bit a block of pixels, kept on the host. Where nothing was drawn nothing can be
//! hidden, so a box that reaches a free block needs no query.
//!
//! Staneker, Bartz, Meissner, *Improving Occlusion Query Efficiency with Occupancy Maps*, 2003, as described in Staneker, Bartz, Strasser,
//! *Efficient Multiple Occlusion Queries for Scene Graph Systems*, 2004, section 3.

mod map;
mod screen;

pub use map::{BlockRect, OccupancyMap};
pub use screen::{BoxPlacement, Containment, PixelRect, Screen};
