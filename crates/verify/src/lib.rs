//! Holding strategies to account: the oracle names every entity that was culled wrongly, and the kit plays scenes made to break a
//! strategy.
//!
//! ```no_run
//! use antumbra_cull::Frustum;
//! use antumbra_verify::kit;
//!
//! kit::assert_conforms(|| Box::new(Frustum));
//! ```

pub mod kit;
mod oracle;

pub use oracle::{EntitySet, IdBuffer, Oracle, TransparentSums};
