//! From local to world, and from boxes to boxes of subtrees. Where little has changed only the changed subtrees and their
//! ancestors are visited; where much has, the arrays are swept front to back (in parallel, run by run) and back to front.

use super::dense::{ATTACH, Dense, LISTED, MOVE, MOVED, NEW, OWN_BOX, REFIT, SCENE, SEEN};
use super::links::Links;
use crate::bounds::Aabb;
use crate::keys::{EntityKey, MeshKey};
use glam::DAffine3;
use rayon::prelude::*;
use slotmap::{Key, SecondaryMap};

/// Slots that are worth a second thread.
const PARALLEL: usize = 4096;

/// What an update found.
pub(super) enum Moved {
    /// These slots' world transforms have changed.
    Some(Vec<u32>),
    /// The slots marked [`MOVED`]; the caller clears `state`.
    Marked,
}

/// The boxes of the meshes.
pub(super) type MeshBoxes = SecondaryMap<MeshKey, Aabb>;

/// Brings world transforms and boxes up to date. `listed` names the entities whose state asks for something.
pub(super) fn propagate(
    dense: &mut Dense,
    links: &Links,
    boxes: &MeshBoxes,
    listed: &[EntityKey],
) -> Moved {
    let mut slots: Vec<u32> = (listed.iter())
        .filter_map(|entity| Some(links.get(*entity)?.slot))
        .collect();
    if slots.len() > dense.len() / 8 {
        sweep(dense, boxes);
        return Moved::Marked;
    }
    slots.sort_unstable();
    let mut walk = Walk {
        dense,
        links,
        boxes,
        visited: Vec::new(),
        moved: Vec::new(),
    };
    if !walk.descend(&slots) {
        sweep(dense, boxes);
        return Moved::Marked;
    }
    walk.ascend();
    Moved::Some(walk.moved)
}

/// The path for few changes.
struct Walk<'a> {
    dense: &'a mut Dense,
    links: &'a Links,
    boxes: &'a MeshBoxes,
    /// Slots whose boxes may have to change, with the part they had in their parent's box.
    visited: Vec<(u32, Aabb)>,
    moved: Vec<u32>,
}

impl Walk<'_> {
    /// Visits the listed slots, ascending, and what hangs below those that moved. False when that has become so much
    /// that a sweep is cheaper; everything asked for is still marked then.
    fn descend(&mut self, slots: &[u32]) -> bool {
        let limit = self.dense.len() / 4;
        let mut below = Vec::new();
        let mut budget = limit;
        // Nothing is written before it is known that the walk is short enough to be finished.
        for &slot in slots {
            if self.dense.state[slot as usize] & (MOVE | SEEN) != MOVE {
                continue;
            }
            below.push(slot);
            while let Some(slot) = below.pop() {
                if self.dense.state[slot as usize] & SEEN != 0 {
                    continue;
                }
                self.dense.state[slot as usize] |= SEEN;
                self.visited.push((slot, Aabb::EMPTY));
                if budget == 0 {
                    for (slot, _) in self.visited.drain(..) {
                        self.dense.state[slot as usize] &= !SEEN;
                    }
                    return false;
                }
                budget -= 1;
                let children = self.links.get(self.dense.key[slot as usize]);
                let children = self.links.siblings(children.and_then(|e| e.children.first));
                below.extend(children.filter_map(|child| Some(self.links.get(child)?.slot)));
            }
        }
        for &slot in slots {
            if self.dense.state[slot as usize] & SEEN == 0 {
                self.dense.state[slot as usize] |= SEEN;
                self.visited.push((slot, Aabb::EMPTY));
            }
        }
        self.visited.sort_unstable_by_key(|(slot, _)| *slot);
        for entry in &mut self.visited {
            let slot = entry.0 as usize;
            entry.1 = self.dense.part_in_parent(slot);
            let parent = self.dense.parent[slot];
            let state = self.dense.state[slot];
            let asked = state & MOVE != 0 || self.dense.state[parent as usize] & MOVED != 0;
            let moved = asked && self.dense.place(slot);
            if moved {
                self.dense.state[slot] |= MOVED;
                if state & NEW == 0 {
                    self.moved.push(entry.0);
                }
            }
            if moved || state & (OWN_BOX | NEW) != 0 {
                let new = own_box(self.dense.mesh[slot], &self.dense.world[slot], self.boxes);
                let old = std::mem::replace(&mut self.dense.own[slot], new);
                self.dense.part_changed(slot, &old, &new);
            }
        }
        true
    }

    /// Hands changed boxes to the parents, the deepest first.
    fn ascend(&mut self) {
        let mut next = 0;
        while let Some(&(slot, _)) = self.visited.get(next) {
            next += 1;
            let parent = self.dense.parent[slot as usize];
            if slot != SCENE && self.dense.state[parent as usize] & SEEN == 0 {
                self.dense.state[parent as usize] |= SEEN;
                let part = self.dense.part_in_parent(parent as usize);
                self.visited.push((parent, part));
            }
        }
        if self.dense.state[SCENE as usize] & SEEN == 0 {
            let part = self.dense.part_in_parent(SCENE as usize);
            self.visited.push((SCENE, part));
        }
        self.visited
            .sort_unstable_by_key(|(slot, _)| std::cmp::Reverse(*slot));
        for &(slot, old) in &self.visited {
            let at = slot as usize;
            if self.dense.state[at] & REFIT != 0 {
                let first = match self.links.get(self.dense.key[at]) {
                    Some(entry) => entry.children.first,
                    None => self.links.roots.first,
                };
                let mut joined = self.dense.own[at];
                for child in self.links.siblings(first) {
                    if let Some(entry) = self.links.get(child) {
                        joined = joined.union(&self.dense.subtree[entry.slot as usize]);
                    }
                }
                self.dense.subtree[at] = joined;
            }
            self.dense.state[at] = 0;
            let new = self.dense.subtree[at];
            if slot != SCENE && new != old {
                let parent = self.dense.parent[at] as usize;
                self.dense.part_changed(parent, &old, &new);
            }
        }
    }
}

impl Dense {
    /// Computes a world transform; whether it differs from before.
    fn place(&mut self, slot: usize) -> bool {
        let world = child_world(self.parent[slot], &self.world, &self.local[slot]);
        let before = std::mem::replace(&mut self.world[slot], world);
        self.state[slot] & NEW != 0 || before != world
    }

    /// The box that this slot's subtree has in its parent's as of the last update.
    pub(super) fn part_in_parent(&self, slot: usize) -> Aabb {
        if self.state[slot] & ATTACH != 0 {
            Aabb::EMPTY
        } else {
            self.subtree[slot]
        }
    }

    /// One of the boxes that `slot`'s subtree box is joined from has changed: the box grows, or, if the old part reached
    /// its border and the new one does not, it must be joined again from all its parts.
    pub(super) fn part_changed(&mut self, slot: usize, old: &Aabb, new: &Aabb) {
        let joined = &mut self.subtree[slot];
        let shrinks_low = old.min.cmple(joined.min) & new.min.cmpgt(old.min);
        let shrinks_high = old.max.cmpge(joined.max) & new.max.cmplt(old.max);
        if !old.is_empty() && (shrinks_low | shrinks_high).any() {
            self.state[slot] |= REFIT;
        }
        *joined = joined.union(new);
    }
}

/// The path for many changes: every slot, front to back, then every box, back to front.
fn sweep(dense: &mut Dense, boxes: &MeshBoxes) {
    let ends = dense
        .runs
        .iter()
        .skip(1)
        .copied()
        .chain([dense.key.len() as u32]);
    for (start, end) in dense.runs.iter().copied().zip(ends) {
        let (start, end) = (start as usize, end as usize);
        let (worlds, world) = dense.world.split_at_mut(start);
        let (states, state) = dense.state.split_at_mut(start);
        let length = end - start;
        let visit = |i: usize, world: &mut DAffine3, own: &mut Aabb, state: &mut u8| {
            let slot = start + i;
            let parent = dense.parent[slot];
            if *state & MOVE != 0 || states[parent as usize] & MOVED != 0 {
                let new = child_world(parent, worlds, &dense.local[slot]);
                if *state & NEW != 0 || *world != new {
                    *world = new;
                    *state |= MOVED;
                }
            }
            if *state & (MOVED | OWN_BOX) != 0 {
                *own = own_box(dense.mesh[slot], world, boxes);
            }
        };
        let own = &mut dense.own[start..end];
        if length < PARALLEL {
            let items = world[..length]
                .iter_mut()
                .zip(own)
                .zip(&mut state[..length]);
            for (i, ((world, own), state)) in items.enumerate() {
                visit(i, world, own, state);
            }
        } else {
            let items = world[..length]
                .par_iter_mut()
                .zip(own)
                .zip(&mut state[..length]);
            items
                .enumerate()
                .with_min_len(PARALLEL / 4)
                .for_each(|(i, ((world, own), state))| visit(i, world, own, state));
        }
    }
    dense.subtree.copy_from_slice(&dense.own);
    for slot in (1..dense.subtree.len()).rev() {
        let parent = dense.parent[slot] as usize;
        dense.subtree[parent] = dense.subtree[parent].union(&dense.subtree[slot]);
    }
}

fn child_world(parent: u32, worlds: &[DAffine3], local: &DAffine3) -> DAffine3 {
    if parent == SCENE {
        return *local;
    }
    worlds[parent as usize] * *local
}

fn own_box(mesh: MeshKey, world: &DAffine3, boxes: &MeshBoxes) -> Aabb {
    if mesh.is_null() {
        return Aabb::EMPTY;
    }
    let own = boxes.get(mesh).map(|bounds| bounds.transformed(world));
    // A product of transforms that left f64's range has no place to draw at.
    own.filter(Aabb::is_finite).unwrap_or(Aabb::EMPTY)
}

/// Clears what an update has worked off.
pub(super) fn settle(dense: &mut Dense) {
    dense.state.fill(0);
}

/// Marks a slot; whether it was not yet in the list.
pub(super) fn mark(dense: &mut Dense, slot: u32, asks: u8) -> bool {
    let state = &mut dense.state[slot as usize];
    let listed = *state & LISTED != 0;
    *state |= asks | LISTED;
    !listed
}
