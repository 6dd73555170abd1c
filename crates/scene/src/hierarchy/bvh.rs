//! Division of wide groups by a bounding volume hierarchy over their members.
//!
//! The hierarchy is built by parallel locally ordered clustering (Meister and Bittner, 2018), as implemented by the
//! crate `obvhs`. Its binary nodes are then collapsed into nodes with up to four children.

use super::input::{CheckedTree, Member, Members};
use super::shape::HierarchyShape;
use crate::bounds::{Aabb, tell_apart};
use glam::{DVec3, Vec3A};
use obvhs::bvh2::Bvh2;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

/// Children per node of a division. With fewer children more boxes are tested on the way down; with more children
/// more of the tests are wasted.
const CHILDREN: usize = 4;

/// Divides every group with more than [`HierarchyShape::MAX_UNDIVIDED`] members.
pub(super) fn divide_wide_groups(tree: &mut CheckedTree) {
    let mut builder = PlocBuilder::new();
    let groups = std::mem::take(&mut tree.groups);
    // Divisions add groups in front of those they divide, so the groups get new numbers.
    let mut renumbered = Vec::with_capacity(groups.len());
    let renumber = |member: &mut Member, renumbered: &[Member]| {
        if let Member::Group(group) = member {
            *member = renumbered.get(*group as usize).copied().unwrap_or(*member);
        }
    };
    for mut members in groups {
        for (member, _) in &mut members {
            renumber(member, &renumbered);
        }
        let members = match members.len() > HierarchyShape::MAX_UNDIVIDED {
            true => divided(tree, &mut builder, &members),
            false => members,
        };
        let own = tree.add_group(members);
        renumbered.push(own.map_or(Member::Group(0), |(member, _)| member));
    }
    if let Some((root, _)) = &mut tree.root {
        renumber(root, &renumbered);
    }
}

/// Groups the members. Returns the remaining members of the divided group.
fn divided(tree: &mut CheckedTree, builder: &mut PlocBuilder, members: &Members) -> Members {
    let around = members
        .iter()
        .fold(Aabb::EMPTY, |all, (_, bounds)| all.union(bounds));
    let mut boxes: Vec<obvhs::aabb::Aabb> = members
        .iter()
        .map(|(_, bounds)| small(bounds, &around))
        .collect();
    tell_apart(&mut boxes);
    let pairs = builder.build(
        PlocSearchDistance::Low,
        &boxes,
        (0..members.len() as u32).collect(),
        SortPrecision::U64,
        0,
    );
    // The nodes from the root down. They are then added from the last one up, so that a node follows those it
    // contains.
    let mut open = vec![0usize];
    let mut parts: Vec<Vec<usize>> = Vec::new();
    while let Some(node) = open.get(parts.len()).copied() {
        let children = gathered(&pairs, node);
        open.extend(children.iter().filter(|child| !is_leaf(&pairs, **child)));
        parts.push(children);
    }
    let mut closed: Vec<Option<(Member, Aabb)>> = vec![None; pairs.nodes.len()];
    for (node, children) in open.iter().zip(&parts).rev() {
        let own: Members = children
            .iter()
            .filter_map(|child| match is_leaf(&pairs, *child) {
                true => member(&pairs, *child, members),
                false => closed.get(*child).copied().flatten(),
            })
            .collect();
        if *node == 0 {
            return own;
        }
        closed[*node] = tree.add_group(own);
    }
    members.clone()
}

/// A box as f32 fractions of the box around all members. The clustering uses only relative distances.
fn small(bounds: &Aabb, around: &Aabb) -> obvhs::aabb::Aabb {
    let middle = around.centre();
    let size = around.half_extents().max_element();
    let scale = if size > 0.0 { size.recip() } else { 0.0 };
    let place = |corner: DVec3| Vec3A::from(((corner - middle) * scale).as_vec3());
    obvhs::aabb::Aabb::new(place(bounds.min), place(bounds.max))
}

fn is_leaf(pairs: &Bvh2, node: usize) -> bool {
    pairs.nodes.get(node).is_none_or(|node| node.prim_count > 0)
}

fn member(pairs: &Bvh2, node: usize, members: &Members) -> Option<(Member, Aabb)> {
    let first = pairs.nodes.get(node)?.first_index as usize;
    let primitive = pairs.primitive_indices.get(first).copied()?;
    members.get(primitive as usize).copied()
}

/// A node's children. The largest inner child is replaced by its own children until there are enough.
fn gathered(pairs: &Bvh2, node: usize) -> Vec<usize> {
    let below = |node: usize| {
        let first = pairs
            .nodes
            .get(node)
            .map_or(0, |node| node.first_index as usize);
        [first, first + 1]
    };
    let mut children = match is_leaf(pairs, node) {
        true => return vec![node],
        false => below(node).to_vec(),
    };
    while children.len() < CHILDREN {
        let area = |child: usize| {
            pairs
                .nodes
                .get(child)
                .map_or(0.0, |node| node.aabb.half_area())
        };
        let inner = children
            .iter()
            .copied()
            .enumerate()
            .filter(|(_, child)| !is_leaf(pairs, *child));
        let Some((at, largest)) = inner.max_by(|a, b| area(a.1).total_cmp(&area(b.1))) else {
            break;
        };
        children.splice(at..=at, below(largest));
    }
    children
}
