//! The front-to-back traversal of a tree of bounding boxes that the hierarchical strategies share. A node that reaches a free block of the
//! occupancy map is drawn or opened at once. Every other node needs a hardware query.
//!
//! Staneker, Bartz, Strasser, *Efficient Multiple Occlusion Queries for Scene Graph Systems*, 2004, section 4.2.
//!
//! Two forms share [`TraversalContext`], the queue and the frontier:
//!
//! | form | state | graph nodes | when answers are used |
//! |---|---|---|---|
//! | [`same_frame`] | [`Traversal`] | a host loop: one batch of queries an iteration | in the same frame, at a sync point an iteration |
//! | [`frame_late`] | [`LateTraversal`] | one pass of queries a frame | in a later frame, without a wait |

mod context;
mod eye_path;
mod frame_late;
mod frontier;
mod inputs;
mod late;
mod memory;
mod multiquery;
mod one_frame;
mod pending;
mod queue;
mod remaining;
mod same_frame;
mod settings;
mod shared_queries;
mod tight_boxes;
mod waiting;

pub use context::{TraversalContext, VisitedNode};
pub use frame_late::frame_late;
pub use late::{LateTraversal, QueriedNodes, TreeVersion};
pub use one_frame::Traversal;
pub use same_frame::same_frame;
pub use settings::{
    AnswerLifetime, DrawOrder, QueryMode, Retests, Sharing, TightBoxes, TraversalSettings,
};
pub use waiting::WaitingTraversal;

pub(crate) use context::{QueuedNode, Visit};
pub(crate) use frontier::Frontier;
pub(crate) use one_frame::QUERY_TRIANGLES;
pub(crate) use pending::{BatchOrganiser, PendingNode, Purpose};
pub(crate) use shared_queries::{QuerySubject, SharedQueries};
