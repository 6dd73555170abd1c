//! The scene's tree as culling needs it: which group each slot lies in, and each group in which other. A group is an entity that others
//! hang below; its number says nothing and stays while the entity lives.

use antumbra_scene::hierarchy::{GroupTree, GroupedLeaf, NONE};

/// Groups by number, and the group of each slot.
#[derive(Debug, Clone, Default)]
pub struct Groups {
    around: Vec<u32>,
    of_slot: Vec<u32>,
    version: u64,
}

impl Groups {
    /// The group around each group, [`NONE`] around one that lies in no other.
    pub fn around(&self) -> &[u32] {
        &self.around
    }

    /// The group a slot lies in, or [`NONE`].
    pub fn of(&self, slot: u32) -> u32 {
        self.of_slot.get(slot as usize).copied().unwrap_or(NONE)
    }

    /// Counts how often what lies in what has changed for those that were there already.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// What a hierarchy over these slots is made from; `leaves` is overwritten with them and their groups.
    pub fn branches<'a>(
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
            groups: &self.around,
            leaves,
        }
    }

    pub(crate) fn add(&mut self, around: u32) -> u32 {
        self.around.push(around);
        self.around.len() as u32 - 1
    }

    pub(crate) fn place(&mut self, slot: u32, group: u32) {
        let at = slot as usize;
        if self.of_slot.len() <= at {
            self.of_slot.resize(at + 1, NONE);
        }
        self.of_slot[at] = group;
    }

    /// Puts a group into another one.
    pub(crate) fn move_group(&mut self, group: u32, around: u32) {
        if let Some(place) = self.around.get_mut(group as usize) {
            *place = around;
        }
        self.version += 1;
    }

    /// Puts a slot that lay in one group into another.
    pub(crate) fn move_slot(&mut self, slot: u32, group: u32) {
        self.place(slot, group);
        self.version += 1;
    }

    /// Forgets all groups, so that they can be numbered anew.
    pub(crate) fn clear(&mut self) {
        self.around.clear();
        self.of_slot.clear();
        self.version += 1;
    }
}
