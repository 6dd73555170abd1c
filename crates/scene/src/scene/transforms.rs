//! The entities' transforms and boxes as a structure of arrays, parents before children.
//!
//! New entities are appended, and removed ones leave holes. The arrays are compacted level by level only when holes
//! or disorder have grown in proportion to the scene. The average cost of a change therefore does not depend on the
//! scene's size.

use super::tree::EntityTree;
use crate::bounds::Aabb;
use crate::keys::{EntityKey, MeshKey};
use glam::DAffine3;
use slotmap::Key;

/// The slot of the scene itself, the parent of every root.
pub(super) const SCENE: u32 = 0;

/// Flag: the world transform must be computed.
pub(super) const TRANSFORM_DIRTY: u8 = 1;
/// Flag: the box of the entity's own drawable must be computed.
pub(super) const BOUNDS_DIRTY: u8 = 2;
/// Flag: the subtree's box must be joined again from its parts, since a part that touched its border has shrunk.
pub(super) const SUBTREE_DIRTY: u8 = 4;
/// Flag: the subtree's box is not part of the parent's yet.
pub(super) const NOT_IN_PARENT: u8 = 8;
/// Flag: the entity has no world transform yet.
pub(super) const NEW: u8 = 16;
/// Flag: the world transform has changed in this update.
pub(super) const MOVED: u8 = 32;
/// Flag: the slot was visited in this update.
pub(super) const VISITED: u8 = 64;
/// Flag: the entity is in the list of dirty entities.
pub(super) const QUEUED: u8 = 128;

/// Arrays with one element per slot, except `runs`.
#[derive(Clone, Debug)]
pub(super) struct TransformTable {
    /// The entity; null in holes and for the scene.
    pub(super) key: Vec<EntityKey>,
    /// The parent's slot, which is always smaller than the child's; the scene's slot for roots.
    pub(super) parent: Vec<u32>,
    pub(super) local: Vec<DAffine3>,
    pub(super) world: Vec<DAffine3>,
    /// The mesh; null where nothing is drawn.
    pub(super) mesh: Vec<MeshKey>,
    pub(super) bounds: Vec<Aabb>,
    pub(super) subtree_bounds: Vec<Aabb>,
    pub(super) flags: Vec<u8>,
    /// The first slots of the runs. The parents of a run's slots all precede the run, so its slots can be computed in
    /// any order.
    pub(super) runs: Vec<u32>,
    holes: usize,
    runs_when_laid_out: usize,
}

impl TransformTable {
    pub(super) fn new() -> Self {
        Self {
            key: vec![EntityKey::null()],
            parent: vec![SCENE],
            local: vec![DAffine3::IDENTITY],
            world: vec![DAffine3::IDENTITY],
            mesh: vec![MeshKey::null()],
            bounds: vec![Aabb::EMPTY],
            subtree_bounds: vec![Aabb::EMPTY],
            flags: vec![0],
            runs: vec![1],
            holes: 0,
            runs_when_laid_out: 1,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.key.len()
    }

    /// Makes room for new entities.
    pub(super) fn reserve(&mut self, entities: usize) {
        self.key.reserve(entities);
        self.parent.reserve(entities);
        self.local.reserve(entities);
        self.world.reserve(entities);
        self.mesh.reserve(entities);
        self.bounds.reserve(entities);
        self.subtree_bounds.reserve(entities);
        self.flags.reserve(entities);
    }

    /// Appends a slot for a new entity.
    pub(super) fn push(&mut self, key: EntityKey, parent: u32, local: DAffine3) -> u32 {
        let slot = self.begin(key, parent);
        self.local.push(local);
        self.world.push(DAffine3::IDENTITY);
        self.mesh.push(MeshKey::null());
        self.bounds.push(Aabb::EMPTY);
        self.subtree_bounds.push(Aabb::EMPTY);
        self.flags.push(NEW | TRANSFORM_DIRTY | NOT_IN_PARENT);
        slot
    }

    /// Copies `slot` to the end, as a child of `parent`, and leaves a hole.
    pub(super) fn relocate(&mut self, slot: u32, parent: u32) -> u32 {
        let from = slot as usize;
        let to = self.begin(self.key[from], parent);
        self.local.push(self.local[from]);
        self.world.push(self.world[from]);
        self.mesh.push(self.mesh[from]);
        self.bounds.push(self.bounds[from]);
        self.subtree_bounds.push(self.subtree_bounds[from]);
        self.flags.push(self.flags[from]);
        self.remove(slot);
        to
    }

    /// Leaves a hole at `slot`.
    pub(super) fn remove(&mut self, slot: u32) {
        let slot = slot as usize;
        self.key[slot] = EntityKey::null();
        self.parent[slot] = SCENE;
        self.mesh[slot] = MeshKey::null();
        self.bounds[slot] = Aabb::EMPTY;
        self.subtree_bounds[slot] = Aabb::EMPTY;
        self.flags[slot] = 0;
        self.holes += 1;
    }

    /// The first slot of the run that contains `slot`.
    pub(super) fn run_start(&self, slot: u32) -> u32 {
        let next = self.runs.partition_point(|start| *start <= slot);
        let run = self.runs.get(next.saturating_sub(1));
        run.copied().unwrap_or(SCENE)
    }

    /// Whether there are enough holes or runs to compact the arrays.
    pub(super) fn is_fragmented(&self) -> bool {
        self.holes > 1024 + self.len() / 2 || self.runs.len() > 1024 + self.runs_when_laid_out * 2
    }

    /// Rebuilds the arrays level by level, with siblings side by side and without holes.
    pub(super) fn compact(&mut self, tree: &mut EntityTree) {
        let mut order: Vec<EntityKey> = tree.siblings(tree.roots.first).collect();
        let mut next = 0;
        while let Some(node) = order.get(next).and_then(|entity| tree.get(*entity)) {
            next += 1;
            order.extend(tree.siblings(node.children.first));
        }
        let mut laid = Self::new();
        laid.subtree_bounds[SCENE as usize] = self.subtree_bounds[SCENE as usize];
        laid.flags[SCENE as usize] = self.flags[SCENE as usize];
        for key in order {
            // Parents precede children, so the parent already has its new slot.
            let Some(node) = tree.get(key) else {
                continue;
            };
            let parent = node.parent.and_then(|parent| tree.get(parent));
            let parent = parent.map_or(SCENE, |parent| parent.slot);
            let from = node.slot as usize;
            let slot = laid.begin(key, parent);
            laid.local.push(self.local[from]);
            laid.world.push(self.world[from]);
            laid.mesh.push(self.mesh[from]);
            laid.bounds.push(self.bounds[from]);
            laid.subtree_bounds.push(self.subtree_bounds[from]);
            laid.flags.push(self.flags[from]);
            if let Some(node) = tree.nodes.get_mut(key) {
                node.slot = slot;
            }
        }
        laid.runs_when_laid_out = laid.runs.len();
        *self = laid;
    }

    /// Sets flags of a slot and marks it as queued. Returns whether the slot was not queued before.
    pub(super) fn set_flags(&mut self, slot: u32, flags: u8) -> bool {
        let state = &mut self.flags[slot as usize];
        let is_queued = *state & QUEUED != 0;
        *state |= flags | QUEUED;
        !is_queued
    }

    /// Clears the flags of all slots.
    pub(super) fn clear_flags(&mut self) {
        self.flags.fill(0);
    }

    /// The box that the slot's subtree had in its parent's box at the last update.
    pub(super) fn part_in_parent(&self, slot: usize) -> Aabb {
        if self.flags[slot] & NOT_IN_PARENT != 0 {
            Aabb::EMPTY
        } else {
            self.subtree_bounds[slot]
        }
    }

    /// Replaces one part of `slot`'s subtree box. The box grows by the new part. If the old part touched the border
    /// and the new one does not, the box is flagged to be joined again from all its parts.
    pub(super) fn part_changed(&mut self, slot: usize, old: &Aabb, new: &Aabb) {
        let joined = &mut self.subtree_bounds[slot];
        let shrinks_low = old.min.cmple(joined.min) & new.min.cmpgt(old.min);
        let shrinks_high = old.max.cmpge(joined.max) & new.max.cmplt(old.max);
        if !old.is_empty() && (shrinks_low | shrinks_high).any() {
            self.flags[slot] |= SUBTREE_DIRTY;
        }
        *joined = joined.union(new);
    }

    fn begin(&mut self, key: EntityKey, parent: u32) -> u32 {
        let slot = self.key.len() as u32;
        self.key.push(key);
        self.parent.push(parent);
        if self.runs.last().is_some_and(|run| parent >= *run) {
            self.runs.push(slot);
        }
        slot
    }
}
