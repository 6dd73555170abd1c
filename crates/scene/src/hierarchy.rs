//! A tree of boxes over drawable things, for culling whole subtrees at once.
//!
//! The tree is the scene's own tree of groups, a bounding volume hierarchy over all leaves, or the scene's tree with
//! its wide groups divided. Nested bounding volumes are from Clark, "Hierarchical Geometric Models for Visible
//! Surface Algorithms",
//! 1976. No function recurses, so a tree may be of any depth.
//!
//! Files: `input` checks the groups, `bvh` divides wide groups, `build` lays the nodes out, `refit` follows changes.

mod build;
mod bvh;
mod error;
mod input;
mod refit;
mod shape;
mod tree;

pub use error::HierarchyError;
pub use input::{GroupTree, GroupedLeaf, NONE};
pub use shape::HierarchyShape;
pub use tree::{Hierarchy, HierarchyNode};
