//! Verification of culling strategies: an oracle that names every false cull, and a conformance kit that every strategy must pass.
//!
//! **The oracle** renders an entity-id buffer with a graph of its own, which no strategy takes part in. An entity that owns a pixel of that
//! buffer and that the strategy did not draw is a false cull:
//!
//! ```no_run
//! use antumbra_cull::{Stage, StageError, StageScene, ViewInput};
//! use antumbra_scene::Camera;
//! use antumbra_verify::{EntitySet, Oracle};
//!
//! /// Slots of the entities that the strategy of a stage with one view of 640 x 480 pixels culls wrongly.
//! fn false_culls(scene: &dyn StageScene, stage: &mut Stage, camera: Camera) -> Result<Vec<u32>, StageError> {
//!     stage.frame(scene, &[ViewInput::new(camera)])?;
//!     let verdicts = stage.verdicts(0, scene)?;
//!     let mut oracle = Oracle::new(scene, [640, 480]);
//!     let reference = oracle.render(scene, &camera, EntitySet::InFrustum)?;
//!     let mut slots = reference.owners();
//!     slots.retain(|slot| !verdicts.get(*slot).draws());
//!     Ok(slots)
//! }
//! ```
//!
//! **The kit** (feature `kit`, on by default) plays scenes that are built to break a strategy and compares every frame with the oracle. One line of a test is enough:
//!
#![cfg_attr(feature = "kit", doc = "```no_run")]
#![cfg_attr(not(feature = "kit"), doc = "```ignore")]
//! use antumbra_cull::FrustumOnly;
//! use antumbra_verify::kit;
//!
//! kit::assert_conforms(|| Box::new(FrustumOnly));
//! ```

#[cfg(feature = "kit")]
pub mod kit;
mod oracle;

pub use oracle::{Differences, EntitySet, IdBuffer, Oracle, TransparentSums};
