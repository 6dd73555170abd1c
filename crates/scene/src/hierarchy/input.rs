//! The input of a hierarchy, and its check: no cycles, no empty groups, no groups with one member.

use super::error::HierarchyError;
use super::shape::HierarchyShape;
use crate::bounds::Aabb;

/// The number that means "no node", "no group" and "no leaf".
pub const NONE: u32 = u32::MAX;

/// The input of a hierarchy: groups within groups, and leaves in groups. Leaves have numbers of the caller, such as
/// slots of a table.
#[derive(Clone, Copy, Debug, Default)]
pub struct GroupTree<'a> {
    /// For each group the number of the group that contains it; [`NONE`] for a group that no other group contains.
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

/// A member of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Member {
    Group(u32),
    Leaf(u32),
}

/// The members of a group with their boxes.
pub(super) type Members = Vec<(Member, Aabb)>;

/// A checked tree without empty groups and without groups of one member.
#[derive(Debug, Default)]
pub(super) struct CheckedTree {
    /// Every group has two members or more, and follows the groups it contains.
    pub(super) groups: Vec<Members>,
    /// The member that contains all others; `None` for an empty tree.
    pub(super) root: Option<(Member, Aabb)>,
}

impl CheckedTree {
    /// Checks the input. For [`HierarchyShape::Bvh`] all leaves become members of one group.
    pub(super) fn new(
        input: GroupTree<'_>,
        shape: HierarchyShape,
        bounds: &impl Fn(u32) -> Aabb,
    ) -> Result<Self, HierarchyError> {
        let order = inside_first(input.groups)?;
        let count = input.groups.len();
        // The last entry is the root group.
        let mut members: Vec<Members> = vec![Vec::new(); count + 1];
        let place = |group: u32| match shape != HierarchyShape::Bvh && group != NONE {
            true => group as usize,
            false => count,
        };
        let mut seen = Vec::new();
        for &GroupedLeaf { leaf, group } in input.leaves {
            known("leaf", leaf, group, count)?;
            let own = bounds(leaf);
            if own == Aabb::EMPTY {
                continue;
            }
            if own.is_empty() || !own.is_finite() {
                return Err(HierarchyError::InvalidBounds { leaf, bounds: own });
            }
            if seen.len() <= leaf as usize {
                seen.resize(leaf as usize + 1, false);
            }
            if std::mem::replace(&mut seen[leaf as usize], true) {
                return Err(HierarchyError::DuplicateLeaf { leaf });
            }
            members[place(group)].push((Member::Leaf(leaf), own));
        }
        let mut tree = Self::default();
        for group in order {
            let own = std::mem::take(&mut members[group as usize]);
            if let Some(member) = tree.add_group(own) {
                members[place(input.groups[group as usize])].push(member);
            }
        }
        let all = members.pop().unwrap_or_default();
        tree.root = tree.add_group(all);
        Ok(tree)
    }

    /// Adds a group with these members. One member is returned itself, and no members give `None`.
    pub(super) fn add_group(&mut self, mut members: Members) -> Option<(Member, Aabb)> {
        if members.len() < 2 {
            return members.pop();
        }
        let around = members
            .iter()
            .fold(Aabb::EMPTY, |all, (_, bounds)| all.union(bounds));
        self.groups.push(members);
        Some((Member::Group(self.groups.len() as u32 - 1), around))
    }
}

fn known(what: &'static str, number: u32, group: u32, groups: usize) -> Result<(), HierarchyError> {
    if group == NONE || (group as usize) < groups {
        return Ok(());
    }
    Err(HierarchyError::UnknownGroup {
        what,
        number,
        group,
        groups,
    })
}

/// The groups in an order in which each precedes the group that contains it.
fn inside_first(groups: &[u32]) -> Result<Vec<u32>, HierarchyError> {
    let mut within = vec![0u32; groups.len()];
    for (group, number) in groups.iter().zip(0u32..) {
        known("group", number, *group, groups.len())?;
        if let Some(count) = within.get_mut(*group as usize) {
            *count += 1;
        }
    }
    let empty = |(count, number): (&u32, u32)| (*count == 0).then_some(number);
    let mut order: Vec<u32> = within.iter().zip(0u32..).filter_map(empty).collect();
    let mut next = 0;
    while let Some(group) = order.get(next).copied() {
        next += 1;
        let around = groups.get(group as usize).copied().unwrap_or(NONE);
        if let Some(count) = within.get_mut(around as usize) {
            *count -= 1;
            if *count == 0 {
                order.push(around);
            }
        }
    }
    match within.iter().position(|count| *count > 0) {
        // A group outside the cycle that contains part of it is waiting too. Following the waiting groups inwards
        // reaches the cycle.
        Some(waiting) => Err(HierarchyError::Cycle {
            group: of_the_ring(groups, &within, waiting as u32),
        }),
        None => Ok(order),
    }
}

/// A group of the cycle that keeps `waiting` from being finished.
fn of_the_ring(groups: &[u32], within: &[u32], waiting: u32) -> u32 {
    let waits = |group: u32| within.get(group as usize).is_some_and(|count| *count > 0);
    let mut inwards = vec![NONE; groups.len()];
    for (around, number) in groups.iter().zip(0u32..) {
        if waits(number)
            && let Some(inner) = inwards.get_mut(*around as usize)
        {
            *inner = number;
        }
    }
    let mut at = waiting;
    for _ in 0..groups.len() {
        at = inwards.get(at as usize).copied().unwrap_or(at);
    }
    at
}
