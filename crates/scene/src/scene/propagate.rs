//! Propagation of transforms from parents to children, and of boxes from children to parents.
//!
//! After few changes only the changed subtrees and their ancestors are visited. After many changes the arrays are
//! swept front to back (in parallel, run by run) and then back to front.

use super::transforms::{
    BOUNDS_DIRTY, MOVED, NEW, SCENE, SUBTREE_DIRTY, TRANSFORM_DIRTY, TransformTable, VISITED,
};
use super::tree::EntityTree;
use crate::bounds::Aabb;
use crate::keys::{EntityKey, MeshKey};
use glam::DAffine3;
use rayon::prelude::*;
use slotmap::{Key, SecondaryMap};

/// The number of slots from which a run is computed in parallel.
const PARALLEL: usize = 4096;

/// The slots whose world transforms have changed.
pub(super) enum MovedSlots {
    /// These slots.
    List(Vec<u32>),
    /// All slots with the flag [`MOVED`]. The caller clears the flags.
    Flagged,
}

/// The boxes of the meshes.
pub(super) type MeshBounds = SecondaryMap<MeshKey, Aabb>;

/// Updates world transforms and boxes. `queued` are the entities with dirty flags.
pub(super) fn propagate(
    transforms: &mut TransformTable,
    tree: &EntityTree,
    boxes: &MeshBounds,
    queued: &[EntityKey],
) -> MovedSlots {
    let mut slots: Vec<u32> = (queued.iter())
        .filter_map(|entity| Some(tree.get(*entity)?.slot))
        .collect();
    if slots.len() > transforms.len() / 8 {
        update_all(transforms, boxes);
        return MovedSlots::Flagged;
    }
    slots.sort_unstable();
    let mut partial = PartialUpdate {
        transforms,
        tree,
        boxes,
        visited: Vec::new(),
        moved: Vec::new(),
    };
    if !partial.descend(&slots) {
        update_all(transforms, boxes);
        return MovedSlots::Flagged;
    }
    partial.ascend();
    MovedSlots::List(partial.moved)
}

/// The update after few changes.
struct PartialUpdate<'a> {
    transforms: &'a mut TransformTable,
    tree: &'a EntityTree,
    boxes: &'a MeshBounds,
    /// The visited slots.
    visited: Vec<Visit>,
    moved: Vec<u32>,
}

/// A slot whose boxes may change.
#[derive(Clone, Copy)]
struct Visit {
    slot: u32,
    /// The box that the slot's subtree had in its parent's box before this update.
    old_part: Aabb,
}

impl Visit {
    fn new(slot: u32) -> Self {
        Self {
            slot,
            old_part: Aabb::EMPTY,
        }
    }
}

impl PartialUpdate<'_> {
    /// Visits the queued slots in ascending order, and the descendants of those that moved. Returns false if these
    /// are so many that an update of all slots is cheaper. All dirty flags are then still set.
    fn descend(&mut self, slots: &[u32]) -> bool {
        let limit = self.transforms.len() / 4;
        let mut below = Vec::new();
        let mut budget = limit;
        // Nothing is written until the number of visits is known.
        for &slot in slots {
            if self.transforms.flags[slot as usize] & (TRANSFORM_DIRTY | VISITED) != TRANSFORM_DIRTY
            {
                continue;
            }
            below.push(slot);
            while let Some(slot) = below.pop() {
                if self.transforms.flags[slot as usize] & VISITED != 0 {
                    continue;
                }
                self.transforms.flags[slot as usize] |= VISITED;
                self.visited.push(Visit::new(slot));
                if budget == 0 {
                    for visit in self.visited.drain(..) {
                        self.transforms.flags[visit.slot as usize] &= !VISITED;
                    }
                    return false;
                }
                budget -= 1;
                let children = self.tree.get(self.transforms.key[slot as usize]);
                let children = self.tree.siblings(children.and_then(|e| e.children.first));
                below.extend(children.filter_map(|child| Some(self.tree.get(child)?.slot)));
            }
        }
        for &slot in slots {
            if self.transforms.flags[slot as usize] & VISITED == 0 {
                self.transforms.flags[slot as usize] |= VISITED;
                self.visited.push(Visit::new(slot));
            }
        }
        self.visited.sort_unstable_by_key(|visit| visit.slot);
        for visit in &mut self.visited {
            let slot = visit.slot as usize;
            visit.old_part = self.transforms.part_in_parent(slot);
            let parent = self.transforms.parent[slot];
            let state = self.transforms.flags[slot];
            let is_dirty =
                state & TRANSFORM_DIRTY != 0 || self.transforms.flags[parent as usize] & MOVED != 0;
            let moved = is_dirty && self.transforms.update_world(slot);
            if moved {
                self.transforms.flags[slot] |= MOVED;
                if state & NEW == 0 {
                    self.moved.push(visit.slot);
                }
            }
            if moved || state & (BOUNDS_DIRTY | NEW) != 0 {
                let new = world_bounds_of(
                    self.transforms.mesh[slot],
                    &self.transforms.world[slot],
                    self.boxes,
                );
                let old = std::mem::replace(&mut self.transforms.bounds[slot], new);
                self.transforms.part_changed(slot, &old, &new);
            }
        }
        true
    }

    /// Passes changed boxes to the parents, deepest slots first.
    fn ascend(&mut self) {
        let mut next = 0;
        while let Some(&Visit { slot, .. }) = self.visited.get(next) {
            next += 1;
            let parent = self.transforms.parent[slot as usize];
            if slot != SCENE && self.transforms.flags[parent as usize] & VISITED == 0 {
                self.transforms.flags[parent as usize] |= VISITED;
                let old_part = self.transforms.part_in_parent(parent as usize);
                self.visited.push(Visit {
                    slot: parent,
                    old_part,
                });
            }
        }
        if self.transforms.flags[SCENE as usize] & VISITED == 0 {
            let old_part = self.transforms.part_in_parent(SCENE as usize);
            self.visited.push(Visit {
                slot: SCENE,
                old_part,
            });
        }
        self.visited
            .sort_unstable_by_key(|visit| std::cmp::Reverse(visit.slot));
        for &Visit {
            slot,
            old_part: old,
        } in &self.visited
        {
            let at = slot as usize;
            if self.transforms.flags[at] & SUBTREE_DIRTY != 0 {
                let first = match self.tree.get(self.transforms.key[at]) {
                    Some(node) => node.children.first,
                    None => self.tree.roots.first,
                };
                let mut joined = self.transforms.bounds[at];
                for child in self.tree.siblings(first) {
                    if let Some(node) = self.tree.get(child) {
                        joined = joined.union(&self.transforms.subtree_bounds[node.slot as usize]);
                    }
                }
                self.transforms.subtree_bounds[at] = joined;
            }
            self.transforms.flags[at] = 0;
            let new = self.transforms.subtree_bounds[at];
            if slot != SCENE && new != old {
                let parent = self.transforms.parent[at] as usize;
                self.transforms.part_changed(parent, &old, &new);
            }
        }
    }
}

impl TransformTable {
    /// Computes a world transform. Returns whether it has changed.
    fn update_world(&mut self, slot: usize) -> bool {
        let world = child_world(self.parent[slot], &self.world, &self.local[slot]);
        let previous = std::mem::replace(&mut self.world[slot], world);
        self.flags[slot] & NEW != 0 || previous != world
    }
}

/// The update after many changes: every slot front to back, then every box back to front.
fn update_all(transforms: &mut TransformTable, boxes: &MeshBounds) {
    let ends = transforms
        .runs
        .iter()
        .skip(1)
        .copied()
        .chain([transforms.key.len() as u32]);
    for (start, end) in transforms.runs.iter().copied().zip(ends) {
        let (start, end) = (start as usize, end as usize);
        let (worlds, world) = transforms.world.split_at_mut(start);
        let (states, state) = transforms.flags.split_at_mut(start);
        let length = end - start;
        let visit = |i: usize, world: &mut DAffine3, own: &mut Aabb, state: &mut u8| {
            let slot = start + i;
            let parent = transforms.parent[slot];
            if *state & TRANSFORM_DIRTY != 0 || states[parent as usize] & MOVED != 0 {
                let new = child_world(parent, worlds, &transforms.local[slot]);
                if *state & NEW != 0 || *world != new {
                    *world = new;
                    *state |= MOVED;
                }
            }
            if *state & (MOVED | BOUNDS_DIRTY) != 0 {
                *own = world_bounds_of(transforms.mesh[slot], world, boxes);
            }
        };
        let own = &mut transforms.bounds[start..end];
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
    transforms
        .subtree_bounds
        .copy_from_slice(&transforms.bounds);
    for slot in (1..transforms.subtree_bounds.len()).rev() {
        let parent = transforms.parent[slot] as usize;
        transforms.subtree_bounds[parent] =
            transforms.subtree_bounds[parent].union(&transforms.subtree_bounds[slot]);
    }
}

fn child_world(parent: u32, worlds: &[DAffine3], local: &DAffine3) -> DAffine3 {
    if parent == SCENE {
        return *local;
    }
    worlds[parent as usize] * *local
}

fn world_bounds_of(mesh: MeshKey, world: &DAffine3, boxes: &MeshBounds) -> Aabb {
    if mesh.is_null() {
        return Aabb::EMPTY;
    }
    let own = boxes.get(mesh).map(|bounds| bounds.transformed(world));
    // A product of transforms that exceeds the range of f64 gives no place to draw at.
    own.filter(Aabb::is_finite).unwrap_or(Aabb::EMPTY)
}
