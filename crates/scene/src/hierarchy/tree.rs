//! The tree of boxes as one array of nodes.

use super::input::NONE;
use crate::bounds::Aabb;
use std::ops::Range;

/// A node: a box around everything below it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HierarchyNode {
    /// The box around everything below the node; [`Aabb::EMPTY`] where nothing is left.
    pub bounds: Aabb,
    /// The number of the parent node, or [`NONE`].
    pub parent: u32,
    pub(super) first_child: u32,
    pub(super) children: u32,
    pub(super) first_leaf: u32,
    pub(super) leaves: u32,
}

impl HierarchyNode {
    /// Whether the node is a leaf.
    #[must_use]
    pub fn is_leaf(&self) -> bool {
        self.children == 0
    }

    /// The numbers of the child nodes, which are neighbours in the array. Empty for a leaf.
    #[must_use]
    pub fn children(&self) -> Range<u32> {
        self.first_child..self.first_child + self.children
    }
}

/// A tree of boxes. A node follows its parent, and an inner node has two children or more.
///
/// ```
/// use antumbra_scene::{Aabb, hierarchy::{GroupTree, GroupedLeaf, Hierarchy, HierarchyShape, NONE}};
/// use glam::DVec3;
///
/// // Two boxes in one group, and a third without a group.
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
    pub(super) nodes: Vec<HierarchyNode>,
    /// The leaves from left to right; [`NONE`] in place of a removed leaf.
    pub(super) leaf_order: Vec<u32>,
    /// The node of each leaf.
    pub(super) node_of: Vec<u32>,
    /// Nodes from here on were added after the tree was built and have no parent.
    pub(super) unattached_from: u32,
    pub(super) removed: u32,
    pub(super) area: f64,
    pub(super) built_area: f64,
    pub(super) dirty: Vec<u32>,
}

impl Hierarchy {
    /// The nodes. Every node follows its parent.
    #[must_use]
    pub fn nodes(&self) -> &[HierarchyNode] {
        &self.nodes
    }

    /// The node with this number.
    #[must_use]
    pub fn node(&self, number: u32) -> Option<&HierarchyNode> {
        self.nodes.get(number as usize)
    }

    /// The nodes without a parent: the root, and leaves that were added after the tree was built.
    pub fn roots(&self) -> impl Iterator<Item = u32> + use<> {
        let root = (self.unattached_from > 0).then_some(0);
        root.into_iter()
            .chain(self.unattached_from..self.nodes.len() as u32)
    }

    /// The leaf of a leaf node; `None` for an inner node and for a removed leaf.
    #[must_use]
    pub fn leaf(&self, number: u32) -> Option<u32> {
        let node = self.node(number).filter(|node| node.is_leaf())?;
        let leaf = self.leaf_order.get(node.first_leaf as usize).copied();
        leaf.filter(|leaf| *leaf != NONE)
    }

    /// All leaves at and below a node, from left to right.
    pub fn leaves_below(&self, number: u32) -> impl Iterator<Item = u32> + Clone + '_ {
        let node = self.node(number);
        let range = node.map_or(0..0, |node| {
            node.first_leaf as usize..(node.first_leaf + node.leaves) as usize
        });
        let leaves = self.leaf_order.get(range).unwrap_or_default();
        leaves.iter().copied().filter(|leaf| *leaf != NONE)
    }

    /// The node of a leaf.
    #[must_use]
    pub fn node_of(&self, leaf: u32) -> Option<u32> {
        let node = self.node_of.get(leaf as usize).copied();
        node.filter(|node| *node != NONE)
    }

    /// Bytes per node, including its leaf entries.
    pub const BYTES_PER_NODE: usize = size_of::<HierarchyNode>() + 2 * size_of::<u32>();
}
