//! Occupancy maps: what of the screen has been drawn to, a bit a block, kept on the host. Where nothing was drawn nothing can hide, so a box
//! that reaches a free block needs no query. Staneker, Bartz, Meissner, *Improving Occlusion Query Efficiency with Occupancy Maps*, 2003, as
//! Staneker, Bartz, Strasser, *Efficient Multiple Occlusion Queries for Scene Graph Systems*, 2004, section 3, tells it.

mod map;
mod screen;

pub use map::{BlockRect, OccupancyMap};
pub use screen::{PixelRect, Place, Screen};
