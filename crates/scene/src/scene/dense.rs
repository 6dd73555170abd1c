//! The entities' transforms and boxes as arrays, parents before children. New entities go to the end, removed ones leave
//! holes, and the arrays are laid out anew, level by level, only when holes or disorder have grown with the scene, so that
//! each change costs the same on average however large the scene is.

use super::links::Links;
use crate::bounds::Aabb;
use crate::keys::{EntityKey, MeshKey};
use glam::DAffine3;
use slotmap::Key;

/// The slot of the scene itself, above every root.
pub(super) const SCENE: u32 = 0;

/// The world transform must be computed again.
pub(super) const MOVE: u8 = 1;
/// The entity's own box must be computed again.
pub(super) const OWN_BOX: u8 = 2;
/// The subtree's box must be joined again from its parts: one that reached its border has shrunk.
pub(super) const REFIT: u8 = 4;
/// The subtree's box is not yet part of the parent's.
pub(super) const ATTACH: u8 = 8;
/// The entity has no world transform yet.
pub(super) const NEW: u8 = 16;
/// The world transform has changed in this update.
pub(super) const MOVED: u8 = 32;
/// Already met in this update.
pub(super) const SEEN: u8 = 64;
/// In the list of what is to be looked at.
pub(super) const LISTED: u8 = 128;

/// One element a slot in each array but `runs`.
#[derive(Clone, Debug)]
pub(super) struct Dense {
    /// Null in holes and for the scene.
    pub(super) key: Vec<EntityKey>,
    /// The parent's slot, always smaller than the own one; the scene's for roots.
    pub(super) parent: Vec<u32>,
    pub(super) local: Vec<DAffine3>,
    pub(super) world: Vec<DAffine3>,
    /// Null where nothing is drawn.
    pub(super) mesh: Vec<MeshKey>,
    pub(super) own: Vec<Aabb>,
    pub(super) subtree: Vec<Aabb>,
    pub(super) state: Vec<u8>,
    /// Where runs begin; the parents of a run's slots all lie before the run, so its slots can be computed in any order.
    pub(super) runs: Vec<u32>,
    holes: usize,
    runs_when_laid_out: usize,
}

impl Dense {
    pub(super) fn new() -> Self {
        Self {
            key: vec![EntityKey::null()],
            parent: vec![SCENE],
            local: vec![DAffine3::IDENTITY],
            world: vec![DAffine3::IDENTITY],
            mesh: vec![MeshKey::null()],
            own: vec![Aabb::EMPTY],
            subtree: vec![Aabb::EMPTY],
            state: vec![0],
            runs: vec![1],
            holes: 0,
            runs_when_laid_out: 1,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.key.len()
    }

    /// Adds a new entity's slot.
    pub(super) fn push(&mut self, key: EntityKey, parent: u32, local: DAffine3) -> u32 {
        let slot = self.begin(key, parent);
        self.local.push(local);
        self.world.push(DAffine3::IDENTITY);
        self.mesh.push(MeshKey::null());
        self.own.push(Aabb::EMPTY);
        self.subtree.push(Aabb::EMPTY);
        self.state.push(NEW | MOVE | ATTACH);
        slot
    }

    /// Copies `slot` to the end, below `parent`, and leaves a hole.
    pub(super) fn relocate(&mut self, slot: u32, parent: u32) -> u32 {
        let from = slot as usize;
        let to = self.begin(self.key[from], parent);
        self.local.push(self.local[from]);
        self.world.push(self.world[from]);
        self.mesh.push(self.mesh[from]);
        self.own.push(self.own[from]);
        self.subtree.push(self.subtree[from]);
        self.state.push(self.state[from]);
        self.remove(slot);
        to
    }

    /// Leaves a hole at `slot`.
    pub(super) fn remove(&mut self, slot: u32) {
        let slot = slot as usize;
        self.key[slot] = EntityKey::null();
        self.parent[slot] = SCENE;
        self.mesh[slot] = MeshKey::null();
        self.own[slot] = Aabb::EMPTY;
        self.subtree[slot] = Aabb::EMPTY;
        self.state[slot] = 0;
        self.holes += 1;
    }

    /// Where the run of `slot` begins.
    pub(super) fn run_start(&self, slot: u32) -> u32 {
        let after = self.runs.partition_point(|start| *start <= slot);
        let run = self.runs.get(after.saturating_sub(1));
        run.copied().unwrap_or(SCENE)
    }

    /// Whether enough has come and gone to lay the arrays out anew.
    pub(super) fn is_untidy(&self) -> bool {
        self.holes > 1024 + self.len() / 2 || self.runs.len() > 1024 + self.runs_when_laid_out * 2
    }

    /// Lays the arrays out level by level, children of one parent side by side, without holes.
    pub(super) fn lay_out(&mut self, links: &mut Links) {
        let mut order: Vec<EntityKey> = links.siblings(links.roots.first).collect();
        let mut next = 0;
        while let Some(entry) = order.get(next).and_then(|entity| links.get(*entity)) {
            next += 1;
            order.extend(links.siblings(entry.children.first));
        }
        let mut laid = Self::new();
        laid.subtree[SCENE as usize] = self.subtree[SCENE as usize];
        laid.state[SCENE as usize] = self.state[SCENE as usize];
        for key in order {
            // Parents come first, so the parent's slot is the new one already.
            let Some(entry) = links.get(key) else {
                continue;
            };
            let parent = entry.parent.and_then(|parent| links.get(parent));
            let parent = parent.map_or(SCENE, |parent| parent.slot);
            let from = entry.slot as usize;
            let slot = laid.begin(key, parent);
            laid.local.push(self.local[from]);
            laid.world.push(self.world[from]);
            laid.mesh.push(self.mesh[from]);
            laid.own.push(self.own[from]);
            laid.subtree.push(self.subtree[from]);
            laid.state.push(self.state[from]);
            if let Some(entry) = links.entries.get_mut(key) {
                entry.slot = slot;
            }
        }
        laid.runs_when_laid_out = laid.runs.len();
        *self = laid;
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
