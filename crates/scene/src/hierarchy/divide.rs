//! Wide groups divided by a bounding volume hierarchy over their members: parallel locally ordered clustering (Meister and Bittner, 2018),
//! as the crate `obvhs` builds it, its pairs gathered into nodes of a few children.

use super::HierarchyShape;
use super::branches::{Member, Members, Tidy};
use crate::bounds::Aabb;
use glam::{DVec3, Vec3A};
use obvhs::bvh2::Bvh2;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

/// Children of a node that comes of a division: with fewer, more boxes are asked about on the way down; with more, more in vain.
const CHILDREN: usize = 4;

/// Divides every group with more than [`HierarchyShape::MAX_UNDIVIDED`] members.
pub(super) fn divide(tidy: &mut Tidy) {
    let mut builder = PlocBuilder::new();
    let groups = std::mem::take(&mut tidy.groups);
    // Divisions add groups before those they divide, so the groups get new numbers.
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
            true => divided(tidy, &mut builder, &members),
            false => members,
        };
        let own = tidy.close(members);
        renumbered.push(own.map_or(Member::Group(0), |(member, _)| member));
    }
    if let Some((root, _)) = &mut tidy.root {
        renumber(root, &renumbered);
    }
}

/// Groups the members and hands out what is left to be the members of their own group.
fn divided(tidy: &mut Tidy, builder: &mut PlocBuilder, members: &Members) -> Members {
    let around = members
        .iter()
        .fold(Aabb::EMPTY, |all, (_, bounds)| all.union(bounds));
    let boxes: Vec<obvhs::aabb::Aabb> = members
        .iter()
        .map(|(_, bounds)| small(bounds, &around))
        .collect();
    let pairs = builder.build(
        PlocSearchDistance::Low,
        &boxes,
        (0..members.len() as u32).collect(),
        SortPrecision::U64,
        0,
    );
    // Nodes from the root down, then closed from the last one up, so that what a node contains is there before it.
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
        closed[*node] = tidy.close(own);
    }
    members.clone()
}

/// A box as f32 fractions of the one around all: the clustering looks at nothing but who is near whom.
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

/// A node's children, the largest of them replaced by its own until there are enough.
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
