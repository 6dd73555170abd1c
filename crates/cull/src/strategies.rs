//! The strategies that come with this crate, one file each.

mod baseline;
mod stop_and_wait;
mod three_pass;

pub use baseline::{Frustum, Ideal, None};
pub use stop_and_wait::StopAndWait;
pub use three_pass::{StandIn, ThreePass};
