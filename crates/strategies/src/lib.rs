//! The built-in culling strategies, one file or folder each.
//!
//! | name | type | source |
//! |---|---|---|
//! | `none`, `frustum`, `ideal` | [`Everything`], [`FrustumOnly`], [`Ideal`] | baselines of `antumbra-cull` |
//! | `stop-and-wait` | [`StopAndWait`] | Bartz, Meissner, Huettner 1999 |
//! | `three-pass` | [`ThreePass`] | Plate, Grundhoefer, Schmidt, Froehlich 2004 |
//! | `coherent`, `stereo-coherent` | [`Coherent`], [`StereoCoherent`] | Mansa, Amundarain, Garcia-Alonso, Matey 2007 |
//! | `depth-pyramid` | [`DepthPyramid`] | Haar, Aaltonen 2015 |
//! | `occupancy-map`, `occupancy-map-single` | [`OccupancyMapBatched`], [`OccupancyMapSingle`] | Staneker, Bartz, Strasser 2004 |
//! | `chc-plus-plus` | [`ChcPlusPlus`] | Mattausch, Bittner, Wimmer 2008 |
//!
//! [`registry`] makes a strategy from its name and settings, as the command line writes them:
//!
//! ```
//! let strategy = antumbra_strategies::registry().parse("three-pass:latency=on-gpu:threshold=4")?;
//! assert_eq!(strategy.name(), "three-pass");
//! # Ok::<(), antumbra_cull::RegistryError>(())
//! ```
//!
//! In code a strategy is a struct with public settings. Either form goes to `antumbra_cull::Stage::new`:
//!
//! ```
//! use antumbra_cull::{Latency, Strategy};
//! use antumbra_strategies::{TestGeometry, ThreePass};
//!
//! let exact = ThreePass {
//!     latency: Latency::SameFrame,
//!     threshold: Some(0),
//!     occluders: TestGeometry::Full,
//!     occludees: TestGeometry::Full,
//!     scale: 1.0,
//!     ..ThreePass::default()
//! };
//! assert!(exact.conservative());
//! ```
//!
//! Every strategy is an ordinary plug-in of `antumbra-cull` and uses its public interface only. [`traversal`] and [`occupancy`] are the parts of
//! the hierarchical strategies that other strategies can reuse.

mod chc_plus_plus;
mod coherent;
mod depth_pyramid;
mod found_on_gpu;
pub mod occupancy;
mod occupancy_map;
mod query_results;
mod rivals;
mod sketch;
mod stop_and_wait;
mod three_pass;
mod transparent;
pub mod traversal;

use antumbra_cull::{Everything, FrustumOnly, Ideal, Registry};

pub use chc_plus_plus::ChcPlusPlus;
pub use coherent::{Coherent, CoherentSettings, StereoCoherent};
pub use depth_pyramid::DepthPyramid;
pub use occupancy_map::{OccupancyMapBatched, OccupancyMapSingle, OccupancySettings};
pub use rivals::Rival;
pub use sketch::{NodeOutcome, Sketch, SketchNode};
pub use stop_and_wait::StopAndWait;
pub use three_pass::{TestGeometry, ThreePass};

/// A registry of the strategies of this crate.
pub fn registry() -> Registry {
    let mut registry = Registry::new();
    registry.register(|| Box::new(Everything));
    registry.register(|| Box::new(FrustumOnly));
    registry.register(|| Box::new(Ideal));
    registry.register(|| Box::new(StopAndWait::default()));
    registry.register(|| Box::new(ThreePass::default()));
    registry.register(|| Box::new(Coherent::default()));
    registry.register(|| Box::new(StereoCoherent::default()));
    registry.register(|| Box::new(DepthPyramid::default()));
    registry.register(|| Box::new(OccupancyMapBatched::default()));
    registry.register(|| Box::new(OccupancyMapSingle::default()));
    registry.register(|| Box::new(ChcPlusPlus::default()));
    registry
}
