//! The strategies that come with this crate, one file or folder each.

mod baseline;
mod coherent;
mod occupancy_map;
mod stop_and_wait;
mod three_pass;

pub use baseline::{Frustum, Ideal, None};
pub use coherent::{Coherence, Coherent, StereoCoherent};
pub use occupancy_map::{Occupancy, OccupancyMapSingle, OccupancyMaps};
pub use stop_and_wait::StopAndWait;
pub use three_pass::{StandIn, ThreePass};
