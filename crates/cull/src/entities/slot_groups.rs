//! The scene's hierarchy as culling needs it: the group of each slot, and the parent of each group. A group is an entity with children; its
//! number is arbitrary and stays the same while the entity exists.

use antumbra_scene::hierarchy::{GroupTree, GroupedLeaf, NONE};

/// The group of each slot, and the parent of each group.
#[derive(Debug, Clone, Default)]
pub struct SlotGroups {
    parents: Vec<u32>,
    of_slot: Vec<u32>,
    version: u64,
}

impl SlotGroups {
    /// The parent of each group by its number; [`NONE`] for a root.
    pub fn parents(&self) -> &[u32] {
        &self.parents
    }

    /// The group of a slot, or [`NONE`].
    pub fn of(&self, slot: u32) -> u32 {
        self.of_slot.get(slot as usize).copied().unwrap_or(NONE)
    }

    /// Increases when an existing group or slot gets another parent.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// The input for a hierarchy over these slots. `leaves` is overwritten with the slots and their groups.
    pub fn group_tree<'a>(
        &'a self,
        slots: impl Iterator<Item = u32>,
        leaves: &'a mut Vec<GroupedLeaf>,
    ) -> GroupTree<'a> {
        leaves.clear();
        leaves.extend(slots.map(|slot| GroupedLeaf {
            leaf: slot,
            group: self.of(slot),
        }));
        GroupTree {
            groups: &self.parents,
            leaves,
        }
    }

    /// Adds a group below `parent` and returns its number.
    pub fn add(&mut self, parent: u32) -> u32 {
        self.parents.push(parent);
        self.parents.len() as u32 - 1
    }

    /// Sets the group of a slot that has none yet.
    pub fn place(&mut self, slot: u32, group: u32) {
        let at = slot as usize;
        if self.of_slot.len() <= at {
            self.of_slot.resize(at + 1, NONE);
        }
        self.of_slot[at] = group;
    }

    /// Gives a group another parent.
    pub fn move_group(&mut self, group: u32, parent: u32) {
        if let Some(place) = self.parents.get_mut(group as usize) {
            *place = parent;
        }
        self.version += 1;
    }

    /// Moves a slot from its group to another.
    pub fn move_slot(&mut self, slot: u32, group: u32) {
        self.place(slot, group);
        self.version += 1;
    }

    /// Removes all groups, so that they can be numbered anew.
    pub fn clear(&mut self) {
        self.parents.clear();
        self.of_slot.clear();
        self.version += 1;
    }
}
