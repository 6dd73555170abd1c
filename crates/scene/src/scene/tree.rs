//! The tree of entities: doubly linked lists of siblings through the entities themselves. The cost of moving an
//! entity does not depend on its number of siblings.

use crate::keys::EntityKey;
use slotmap::SlotMap;

/// An entity's links in the tree, and its slot in the transform arrays.
#[derive(Clone, Debug, Default)]
pub(super) struct TreeNode {
    pub(super) slot: u32,
    pub(super) parent: Option<EntityKey>,
    pub(super) children: Siblings,
    previous: Option<EntityKey>,
    next: Option<EntityKey>,
}

/// The ends of a list of siblings.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Siblings {
    pub(super) first: Option<EntityKey>,
    last: Option<EntityKey>,
}

/// All entities, and the list of roots.
#[derive(Clone, Debug, Default)]
pub(super) struct EntityTree {
    pub(super) nodes: SlotMap<EntityKey, TreeNode>,
    pub(super) roots: Siblings,
}

impl EntityTree {
    pub(super) fn get(&self, entity: EntityKey) -> Option<&TreeNode> {
        self.nodes.get(entity)
    }

    /// Appends `entity`, which has no parent, to the children of `parent`.
    pub(super) fn attach(&mut self, entity: EntityKey, parent: Option<EntityKey>) {
        let last = self.ends(parent).map(|ends| ends.last.replace(entity));
        let last = last.flatten();
        match last.and_then(|last| self.nodes.get_mut(last)) {
            Some(node) => node.next = Some(entity),
            None => {
                if let Some(ends) = self.ends(parent) {
                    ends.first = Some(entity);
                }
            }
        }
        if let Some(node) = self.nodes.get_mut(entity) {
            (node.parent, node.previous, node.next) = (parent, last, None);
        }
    }

    /// Removes `entity` from its parent's children.
    pub(super) fn detach(&mut self, entity: EntityKey) {
        let Some(node) = self.nodes.get_mut(entity) else {
            return;
        };
        let parent = node.parent.take();
        let (previous, next) = (node.previous.take(), node.next.take());
        match previous.and_then(|previous| self.nodes.get_mut(previous)) {
            Some(node) => node.next = next,
            None => {
                if let Some(ends) = self.ends(parent) {
                    ends.first = next;
                }
            }
        }
        match next.and_then(|next| self.nodes.get_mut(next)) {
            Some(node) => node.previous = previous,
            None => {
                if let Some(ends) = self.ends(parent) {
                    ends.last = previous;
                }
            }
        }
    }

    /// The siblings from `first` to the last.
    pub(super) fn siblings(
        &self,
        first: Option<EntityKey>,
    ) -> impl Iterator<Item = EntityKey> + '_ {
        std::iter::successors(first, |entity| self.nodes.get(*entity)?.next)
    }

    /// `entity` and all its descendants. Every entity follows its parent.
    pub(super) fn subtree(&self, entity: EntityKey) -> Vec<EntityKey> {
        let mut found = vec![entity];
        let mut next = 0;
        while let Some(node) = found.get(next).and_then(|entity| self.nodes.get(*entity)) {
            next += 1;
            found.extend(self.siblings(node.children.first));
        }
        found
    }

    fn ends(&mut self, parent: Option<EntityKey>) -> Option<&mut Siblings> {
        match parent {
            None => Some(&mut self.roots),
            Some(parent) => self.nodes.get_mut(parent).map(|node| &mut node.children),
        }
    }
}
