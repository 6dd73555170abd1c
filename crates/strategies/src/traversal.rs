//! The walk down a tree of boxes, front to back, that hierarchical strategies share: what is free in the occupancy map is drawn or opened at
//! once, what is not waits for a query.
//!
//! Staneker, Bartz, Strasser, *Efficient Multiple Occlusion Queries for Scene Graph Systems*, 2004, section 4.2.

mod context;
mod frame_late;
mod frontier;
mod inputs;
mod late;
mod memory;
mod one_frame;
mod queue;
mod remaining;
mod same_frame;

pub use context::{TraversalContext, VisitedNode};
pub use frame_late::frame_late;
pub use late::{LateTraversal, QueriedNodes};
pub use memory::AnswerLifetime;
pub use one_frame::{DrawOrder, QueryMode, Traversal, TraversalSettings};
pub use same_frame::same_frame;
pub(crate) use same_frame::submit_transparent;
