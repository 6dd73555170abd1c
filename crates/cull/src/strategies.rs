//! The strategies that come with this crate, one file or folder each.

mod baseline;
mod coherent;
mod stop_and_wait;
mod three_pass;

pub use baseline::{Frustum, Ideal, None};
pub use coherent::{Coherence, Coherent, StereoCoherent};
pub use stop_and_wait::StopAndWait;
pub use three_pass::{StandIn, ThreePass};
