//! Why a hierarchy is refused.

use crate::bounds::Aabb;
use thiserror::Error;

/// Why the input of a hierarchy is refused.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum HierarchyError {
    /// A group contains itself, directly or through others.
    #[error(
        "group {group} lies within itself: a hierarchy has no cycles; take the group out of what it contains"
    )]
    Cycle {
        /// One of the groups of the cycle.
        group: u32,
    },
    /// A group or leaf is in a group that does not exist.
    #[error("{what} {number} is in group {group}, but there are only {groups} groups")]
    UnknownGroup {
        /// "group" or "leaf".
        what: &'static str,
        /// Its number.
        number: u32,
        /// The number of the group.
        group: u32,
        /// The number of groups.
        groups: usize,
    },
    /// A leaf occurs twice.
    #[error("leaf {leaf} occurs twice: list it once, with one group")]
    DuplicateLeaf {
        /// Its number.
        leaf: u32,
    },
    /// A leaf's box has its least corner beyond its greatest, or a corner that is not finite.
    #[error("the box of leaf {leaf} is invalid: it runs from {} to {}", bounds.min, bounds.max)]
    InvalidBounds {
        /// Its number.
        leaf: u32,
        /// The box as given.
        bounds: Aabb,
    },
}
