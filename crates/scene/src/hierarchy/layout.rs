//! A tidied tree as one array, level by level: siblings are neighbours, parents come first.

use super::branches::{Member, Tidy};
use super::{Hierarchy, HierarchyNode, NONE};

/// Lays the tree out.
pub(super) fn lay_out(tidy: &Tidy) -> Hierarchy {
    let mut tree = Hierarchy::default();
    let Some((root, bounds)) = tidy.root else {
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
            && let Some(inner) = tidy.groups.get(group as usize)
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
    // From left to right: a node's leaves begin where those of the sibling before it end.
    for at in 0..tree.nodes.len() {
        let mut first = tree.nodes[at].first_leaf;
        for child in tree.nodes[at].children() {
            let child = &mut tree.nodes[child as usize];
            child.first_leaf = first;
            first += child.leaves;
        }
    }
    tree.order = vec![NONE; tree.nodes[0].leaves as usize];
    for (member, number) in members.iter().zip(0u32..) {
        if let Member::Leaf(leaf) = member {
            let first = tree.nodes[number as usize].first_leaf;
            tree.order[first as usize] = *leaf;
            tree.place(*leaf, number);
        }
    }
    tree.loose_from = tree.nodes.len() as u32;
    let inner = tree.nodes.iter().filter(|node| !node.is_leaf());
    tree.area = inner.map(|node| super::refit::area(&node.bounds)).sum();
    tree.area_when_made = tree.area;
    tree
}
