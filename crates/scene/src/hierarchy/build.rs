//! Building a hierarchy: the checked tree becomes one array, level by level. Siblings are neighbours, and parents
//! precede their children.

use super::bvh::divide_wide_groups;
use super::error::HierarchyError;
use super::input::{CheckedTree, GroupTree, Member, NONE};
use super::shape::HierarchyShape;
use super::tree::{Hierarchy, HierarchyNode};
use crate::bounds::Aabb;

impl Hierarchy {
    /// Builds the tree. `bounds` gives the box of a leaf. A leaf with an empty box is left out, and so is a group
    /// without leaves. A group with one member is replaced by that member.
    ///
    /// # Errors
    /// [`HierarchyError`], with the number of the group or leaf.
    pub fn new(
        input: GroupTree<'_>,
        shape: HierarchyShape,
        bounds: impl Fn(u32) -> Aabb,
    ) -> Result<Self, HierarchyError> {
        let mut checked = CheckedTree::new(input, shape, &bounds)?;
        if shape != HierarchyShape::Groups {
            divide_wide_groups(&mut checked);
        }
        Ok(lay_out(&checked))
    }
}

/// Lays the nodes out in one array.
fn lay_out(checked: &CheckedTree) -> Hierarchy {
    let mut tree = Hierarchy::default();
    let Some((root, bounds)) = checked.root else {
        return tree;
    };
    let node = |bounds, parent| HierarchyNode {
        bounds,
        parent,
        first_child: 0,
        children: 0,
        first_leaf: 0,
        leaves: 0,
    };
    tree.nodes.push(node(bounds, NONE));
    let mut members = vec![root];
    let mut at = 0;
    while let Some(member) = members.get(at).copied() {
        let first = tree.nodes.len() as u32;
        let mut children = 0;
        if let Member::Group(group) = member
            && let Some(inner) = checked.groups.get(group as usize)
        {
            children = inner.len() as u32;
            for (member, bounds) in inner {
                tree.nodes.push(node(*bounds, at as u32));
                members.push(*member);
            }
        }
        let own = &mut tree.nodes[at];
        (own.first_child, own.children) = (first, children);
        own.leaves = u32::from(children == 0);
        at += 1;
    }
    for at in (1..tree.nodes.len()).rev() {
        let HierarchyNode { parent, leaves, .. } = tree.nodes[at];
        tree.nodes[parent as usize].leaves += leaves;
    }
    // From left to right: a node's leaves begin where those of the preceding sibling end.
    for at in 0..tree.nodes.len() {
        let mut first = tree.nodes[at].first_leaf;
        for child in tree.nodes[at].children() {
            let child = &mut tree.nodes[child as usize];
            child.first_leaf = first;
            first += child.leaves;
        }
    }
    tree.leaf_order = vec![NONE; tree.nodes[0].leaves as usize];
    for (member, number) in members.iter().zip(0u32..) {
        if let Member::Leaf(leaf) = member {
            let first = tree.nodes[number as usize].first_leaf;
            tree.leaf_order[first as usize] = *leaf;
            tree.set_node(*leaf, number);
        }
    }
    tree.unattached_from = tree.nodes.len() as u32;
    let inner = tree.nodes.iter().filter(|node| !node.is_leaf());
    tree.area = inner.map(|node| node.bounds.half_area()).sum();
    tree.built_area = tree.area;
    tree
}
