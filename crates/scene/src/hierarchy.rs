//! A tree of boxes over what is drawn, for whoever culls whole sub-trees at once: the scene's own tree, a bounding volume hierarchy over
//! flat ones, or the scene's tree with its wide nodes divided. Bounding volumes by nesting: Clark, "Hierarchical Geometric Models for
//! Visible Surface Algorithms", 1976. Nothing here recurses: a tree may be as deep as it likes.

mod branches;
mod divide;
mod layout;
mod refit;

use crate::bounds::Aabb;
use branches::Tidy;
use std::fmt;
use std::ops::Range;
use std::str::FromStr;
use thiserror::Error;

/// Stands for no node, no group and no leaf.
pub const NONE: u32 = u32::MAX;

/// Who hangs where: groups within groups, and leaves in groups. Leaves are numbers of the caller's own (slots of a table, say).
#[derive(Clone, Copy, Debug, Default)]
pub struct GroupTree<'a> {
    /// The group around each group; [`NONE`] around one that lies in no other.
    pub groups: &'a [u32],
    /// Each leaf, once.
    pub leaves: &'a [GroupedLeaf],
}

/// A leaf and the group that contains it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GroupedLeaf {
    /// The leaf's number.
    pub leaf: u32,
    /// The number of the group that contains the leaf, or [`NONE`].
    pub group: u32,
}

/// Where a hierarchy's inner nodes come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum HierarchyShape {
    /// The groups, as they are.
    Groups,
    /// A bounding volume hierarchy over all leaves, whatever their groups.
    Bvh,
    /// The groups, those with more than [`HierarchyShape::MAX_UNDIVIDED`] members divided by bounding volume hierarchies of their own.
    #[default]
    Divided,
}

impl HierarchyShape {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Groups, Self::Bvh, Self::Divided];
    /// Their words, in the order of [`Self::ALL`].
    pub const WORDS: &[&str] = &["groups", "boxes", "divided"];
    /// The most members of a group that is left undivided.
    pub const MAX_UNDIVIDED: usize = 16;

    /// Its word in settings and messages.
    pub fn word(self) -> &'static str {
        match self {
            Self::Groups => "groups",
            Self::Bvh => "boxes",
            Self::Divided => "divided",
        }
    }
}

impl fmt::Display for HierarchyShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for HierarchyShape {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let mut all = Self::ALL.into_iter();
        all.find(|shape| shape.word() == text).ok_or(())
    }
}

/// Why a tree is none.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum HierarchyError {
    /// A group that lies in itself, directly or through others.
    #[error(
        "group {group} lies within itself: no box of it comes before another; take it out of what it contains"
    )]
    Cycle {
        /// One of the groups of the ring.
        group: u32,
    },
    /// A group or leaf that lies in a group which does not exist.
    #[error("{what} {number} lies in group {group}, and there are {groups} groups")]
    UnknownGroup {
        /// "group" or "leaf".
        what: &'static str,
        /// Which.
        number: u32,
        /// The group it names.
        group: u32,
        /// How many there are.
        groups: usize,
    },
    /// A leaf that is named twice.
    #[error("leaf {leaf} hangs in the tree twice: give it one group")]
    DuplicateLeaf {
        /// Which.
        leaf: u32,
    },
    /// A leaf whose box has its least corner beyond its greatest, or a corner that is no number.
    #[error("the box of leaf {leaf} is no box: from {} to {}", bounds.min, bounds.max)]
    InvalidBounds {
        /// Which.
        leaf: u32,
        /// What was given for a box.
        bounds: Aabb,
    },
}

/// A node: a box around everything below it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HierarchyNode {
    /// Around everything below; [`Aabb::EMPTY`] where nothing is left.
    pub bounds: Aabb,
    /// The node above, or [`NONE`].
    pub parent: u32,
    first_child: u32,
    children: u32,
    first_leaf: u32,
    leaves: u32,
}

impl HierarchyNode {
    /// Whether it is a leaf.
    #[must_use]
    pub fn is_leaf(&self) -> bool {
        self.children == 0
    }

    /// The nodes directly below, neighbours in the array; none below a leaf.
    #[must_use]
    pub fn children(&self) -> Range<u32> {
        self.first_child..self.first_child + self.children
    }
}

/// A tree of boxes. A node comes after its parent; inner nodes have two children or more.
///
/// ```
/// use antumbra_scene::{Aabb, hierarchy::{GroupTree, GroupedLeaf, Hierarchy, HierarchyShape, NONE}};
/// use glam::DVec3;
///
/// // Two boxes in one group, a third beside it.
/// let leaves = [(0, 0), (1, 0), (2, NONE)].map(|(leaf, group)| GroupedLeaf { leaf, group });
/// let bounds = |leaf: u32| Aabb::from_centre(DVec3::X * f64::from(leaf) * 3.0, DVec3::ONE);
/// let tree = Hierarchy::new(GroupTree { groups: &[NONE], leaves: &leaves }, HierarchyShape::Groups, bounds)?;
/// let root = tree.roots().next().and_then(|root| tree.node(root));
/// assert_eq!(root.map(|node| node.bounds.max.x), Some(7.0));
/// assert_eq!(tree.leaves_below(0).count(), 3);
/// # Ok::<(), antumbra_scene::hierarchy::HierarchyError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Hierarchy {
    nodes: Vec<HierarchyNode>,
    /// The leaves from left to right; [`NONE`] where one was taken out.
    order: Vec<u32>,
    /// The node of each leaf.
    node_of: Vec<u32>,
    /// Nodes from here on came after the tree was made and hang nowhere.
    loose_from: u32,
    gone: u32,
    area: f64,
    area_when_made: f64,
    dirty: Vec<u32>,
}

impl Hierarchy {
    /// Makes the tree. A leaf with an empty box is left out; so is a group without leaves. A group of one member is that member.
    ///
    /// # Errors
    /// [`HierarchyError`]: what is wrong, with its number.
    pub fn new(
        branches: GroupTree<'_>,
        shape: HierarchyShape,
        bounds: impl Fn(u32) -> Aabb,
    ) -> Result<Self, HierarchyError> {
        let mut tidy = Tidy::new(branches, shape != HierarchyShape::Bvh, &bounds)?;
        if shape != HierarchyShape::Groups {
            divide::divide(&mut tidy);
        }
        Ok(layout::lay_out(&tidy))
    }

    /// The nodes, every one after its parent.
    #[must_use]
    pub fn nodes(&self) -> &[HierarchyNode] {
        &self.nodes
    }

    /// A node by its number.
    #[must_use]
    pub fn node(&self, number: u32) -> Option<&HierarchyNode> {
        self.nodes.get(number as usize)
    }

    /// The nodes without a parent: the root, and leaves that came after the tree was made.
    pub fn roots(&self) -> impl Iterator<Item = u32> + use<> {
        let root = (self.loose_from > 0).then_some(0);
        root.into_iter()
            .chain(self.loose_from..self.nodes.len() as u32)
    }

    /// The leaf that a node is; `None` of an inner one and of one that was taken out.
    #[must_use]
    pub fn leaf(&self, number: u32) -> Option<u32> {
        let node = self.node(number).filter(|node| node.is_leaf())?;
        let leaf = self.order.get(node.first_leaf as usize).copied();
        leaf.filter(|leaf| *leaf != NONE)
    }

    /// All leaves at and below a node, from left to right.
    pub fn leaves_below(&self, number: u32) -> impl Iterator<Item = u32> + Clone + '_ {
        let node = self.node(number);
        let range = node.map_or(0..0, |node| {
            node.first_leaf as usize..(node.first_leaf + node.leaves) as usize
        });
        let leaves = self.order.get(range).unwrap_or_default();
        leaves.iter().copied().filter(|leaf| *leaf != NONE)
    }

    /// The node of a leaf.
    #[must_use]
    pub fn node_of(&self, leaf: u32) -> Option<u32> {
        let node = self.node_of.get(leaf as usize).copied();
        node.filter(|node| *node != NONE)
    }

    /// Bytes a node takes, its leaves' places included.
    pub const BYTES_PER_NODE: usize = size_of::<HierarchyNode>() + 2 * size_of::<u32>();
}
