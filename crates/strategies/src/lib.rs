//! The built-in culling strategies, one file or folder each, and [`registry`], which makes them by name.
//!
//! Each is an ordinary plug-in of `antumbra-cull`: what a strategy here can do, a strategy of another crate can do as well.
//!
//! ```
//! let strategy = antumbra_strategies::registry().parse("three-pass:latency=on-gpu:threshold=4")?;
//! assert_eq!(strategy.name(), "three-pass");
//! # Ok::<(), antumbra_cull::RegistryError>(())
//! ```

mod coherent;
pub mod occupancy;
mod occupancy_map;
mod sketch;
mod stop_and_wait;
mod three_pass;
pub mod traversal;

use antumbra_cull::{Everything, Frustum, Ideal, Registry};

pub use coherent::{Coherent, CoherentSettings, StereoCoherent};
pub use occupancy_map::{OccupancyMapBatched, OccupancyMapSingle, OccupancySettings};
pub use sketch::{NodeOutcome, Sketch, SketchNode};
pub use stop_and_wait::StopAndWait;
pub use three_pass::{TestGeometry, ThreePass};

/// The strategies of this crate, by name.
pub fn registry() -> Registry {
    let mut registry = Registry::new();
    registry.register(|| Box::new(Everything));
    registry.register(|| Box::new(Frustum));
    registry.register(|| Box::new(Ideal));
    registry.register(|| Box::new(StopAndWait::default()));
    registry.register(|| Box::new(ThreePass::default()));
    registry.register(|| Box::new(Coherent::default()));
    registry.register(|| Box::new(StereoCoherent::default()));
    registry.register(|| Box::new(OccupancyMapBatched::default()));
    registry.register(|| Box::new(OccupancyMapSingle::default()));
    registry
}
