//! Who hangs below whom: doubly linked lists of siblings through the entities themselves, so that hanging an entity
//! somewhere else costs the same however many siblings it has.

use crate::keys::EntityKey;
use slotmap::SlotMap;

/// An entity's place in the tree and in the dense arrays.
#[derive(Clone, Debug, Default)]
pub(super) struct Entry {
    pub(super) slot: u32,
    pub(super) parent: Option<EntityKey>,
    pub(super) children: Ends,
    before: Option<EntityKey>,
    after: Option<EntityKey>,
}

/// First and last of a list of siblings.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ends {
    pub(super) first: Option<EntityKey>,
    last: Option<EntityKey>,
}

/// Every entity, and those without a parent.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    pub(super) entries: SlotMap<EntityKey, Entry>,
    pub(super) roots: Ends,
}

impl Links {
    pub(super) fn get(&self, entity: EntityKey) -> Option<&Entry> {
        self.entries.get(entity)
    }

    /// Hangs `entity`, which hangs nowhere, below `parent` as its last child.
    pub(super) fn attach(&mut self, entity: EntityKey, parent: Option<EntityKey>) {
        let last = self.ends(parent).map(|ends| ends.last.replace(entity));
        let last = last.flatten();
        match last.and_then(|last| self.entries.get_mut(last)) {
            Some(entry) => entry.after = Some(entity),
            None => {
                if let Some(ends) = self.ends(parent) {
                    ends.first = Some(entity);
                }
            }
        }
        if let Some(entry) = self.entries.get_mut(entity) {
            (entry.parent, entry.before, entry.after) = (parent, last, None);
        }
    }

    /// Takes `entity` out of its parent's children.
    pub(super) fn detach(&mut self, entity: EntityKey) {
        let Some(entry) = self.entries.get_mut(entity) else {
            return;
        };
        let parent = entry.parent.take();
        let (before, after) = (entry.before.take(), entry.after.take());
        match before.and_then(|before| self.entries.get_mut(before)) {
            Some(entry) => entry.after = after,
            None => {
                if let Some(ends) = self.ends(parent) {
                    ends.first = after;
                }
            }
        }
        match after.and_then(|after| self.entries.get_mut(after)) {
            Some(entry) => entry.before = before,
            None => {
                if let Some(ends) = self.ends(parent) {
                    ends.last = before;
                }
            }
        }
    }

    /// From `first` on to the last sibling.
    pub(super) fn siblings(
        &self,
        first: Option<EntityKey>,
    ) -> impl Iterator<Item = EntityKey> + '_ {
        std::iter::successors(first, |entity| self.entries.get(*entity)?.after)
    }

    /// `entity` and everything below it, every entity after its parent.
    pub(super) fn subtree(&self, entity: EntityKey) -> Vec<EntityKey> {
        let mut found = vec![entity];
        let mut next = 0;
        while let Some(entry) = found.get(next).and_then(|entity| self.entries.get(*entity)) {
            next += 1;
            found.extend(self.siblings(entry.children.first));
        }
        found
    }

    fn ends(&mut self, parent: Option<EntityKey>) -> Option<&mut Ends> {
        match parent {
            None => Some(&mut self.roots),
            Some(parent) => self
                .entries
                .get_mut(parent)
                .map(|entry| &mut entry.children),
        }
    }
}
