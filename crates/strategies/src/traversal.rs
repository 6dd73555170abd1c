//! The walk down a tree of boxes, front to back, that hierarchical strategies share: what is free in the occupancy map is drawn or opened at
//! once, what is not waits for a query.
//!
//! Staneker, Bartz, Strasser, *Efficient Multiple Occlusion Queries for Scene Graph Systems*, 2004, section 4.2.

mod frame_late;
mod front;
mod late_walk;
mod left;
mod looking;
mod memory;
mod queue;
mod same_frame;
mod sight;
mod walk;

pub use frame_late::frame_late;
pub use late_walk::{AskedNodes, LateWalk};
pub use memory::Remember;
pub use same_frame::same_frame;
pub(crate) use same_frame::submit_transparent;
pub use sight::{Met, Sight};
pub use walk::{Asking, How, Order, Walk};
