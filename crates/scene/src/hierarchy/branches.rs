//! What was handed in, checked and tidied: no rings, no empty groups, no groups of one.

use super::{GroupTree, GroupedLeaf, HierarchyError, NONE};
use crate::bounds::Aabb;

/// A member of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Member {
    Group(u32),
    Leaf(u32),
}

/// A group's members with their boxes.
pub(super) type Members = Vec<(Member, Aabb)>;

/// A tidied tree.
#[derive(Debug, Default)]
pub(super) struct Tidy {
    /// Every group of two members or more; a group comes after those it contains.
    pub(super) groups: Vec<Members>,
    /// What everything lies in.
    pub(super) root: Option<(Member, Aabb)>,
}

impl Tidy {
    /// Checks and tidies. Without `grouped` all leaves are members of one group.
    pub(super) fn new(
        branches: GroupTree<'_>,
        grouped: bool,
        bounds: &impl Fn(u32) -> Aabb,
    ) -> Result<Self, HierarchyError> {
        let order = inside_first(branches.groups)?;
        let count = branches.groups.len();
        // The last of them is what everything lies in.
        let mut members: Vec<Members> = vec![Vec::new(); count + 1];
        let place = |group: u32| match grouped && group != NONE {
            true => group as usize,
            false => count,
        };
        let mut seen = Vec::new();
        for &GroupedLeaf { leaf, group } in branches.leaves {
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
        let mut tidy = Self::default();
        for group in order {
            let own = std::mem::take(&mut members[group as usize]);
            if let Some(member) = tidy.close(own) {
                members[place(branches.groups[group as usize])].push(member);
            }
        }
        let all = members.pop().unwrap_or_default();
        tidy.root = tidy.close(all);
        Ok(tidy)
    }

    /// A group of these members; of one member, that member; of none, nothing.
    pub(super) fn close(&mut self, mut members: Members) -> Option<(Member, Aabb)> {
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

/// The groups in an order in which each comes before the one it lies in.
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
        // A group around the ring, rather than of it, waits for it too: go inwards until one comes up again.
        Some(waiting) => Err(HierarchyError::Cycle {
            group: of_the_ring(groups, &within, waiting as u32),
        }),
        None => Ok(order),
    }
}

/// A group of the ring that keeps `waiting` from being closed.
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
