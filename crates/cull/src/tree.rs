//! The tree of boxes that hierarchical strategies traverse, updated with the scene's table.

use antumbra_scene::Aabb;
use antumbra_scene::hierarchy::{GroupedLeaf, Hierarchy, HierarchyError, HierarchyShape};

use crate::entities::{MeshDetail, SceneTable};

/// A hierarchy over all slots that a test may cull, with the number of triangles below each node.
#[derive(Debug, Clone, Default)]
pub struct Tree {
    hierarchy: Hierarchy,
    /// Triangles at and below each node.
    weights: Vec<u32>,
    /// Slots of entities that no test may cull, ascending.
    untested: Vec<u32>,
    made_for: Option<(u64, u64)>,
    generation: u64,
    leaves: Vec<GroupedLeaf>,
}

impl Tree {
    /// The boxes.
    pub fn hierarchy(&self) -> &Hierarchy {
        &self.hierarchy
    }

    /// Slots of entities that no test may cull, ascending: they are in no node.
    pub fn untested(&self) -> &[u32] {
        &self.untested
    }

    /// Triangles at and below a node when the tree was made; lines and points count as triangles.
    pub fn weight(&self, node: u32) -> u32 {
        self.weights.get(node as usize).copied().unwrap_or(0)
    }

    /// Counts the rebuilds of the tree: what is remembered by node is void after one.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// Updates the tree from the table: refits what moved, inserts and removes entities, and rebuilds where that is better.
    ///
    /// # Errors
    /// [`HierarchyError`] where the table's groups are no tree.
    pub fn follow(
        &mut self,
        table: &SceneTable,
        shape: HierarchyShape,
    ) -> Result<(), HierarchyError> {
        let now = (table.epoch(), table.groups().version());
        match self.made_for {
            Some(before) if before == now => return Ok(()),
            Some((epoch, version)) if version == now.1 => {
                match table.changed_since(epoch) {
                    Some(changed) => self.refit(table, epoch, changed.iter().copied()),
                    None => self.refit(table, epoch, 0..table.slots()),
                }
                if self.hierarchy.needs_rebuild() {
                    self.make(table, shape)?;
                }
            }
            _ => self.make(table, shape)?,
        }
        self.made_for = Some(now);
        Ok(())
    }

    fn make(&mut self, table: &SceneTable, shape: HierarchyShape) -> Result<(), HierarchyError> {
        let tested = table.live_slots().filter(|slot| table.is_tested(*slot));
        let branches = table.groups().group_tree(tested, &mut self.leaves);
        self.hierarchy = Hierarchy::new(branches, shape, |slot| bounds(table, slot))?;
        self.untested.clear();
        let untested = table.live_slots().filter(|slot| !table.is_tested(*slot));
        self.untested.extend(untested);
        self.weights.clear();
        self.weigh(table);
        self.generation += 1;
        Ok(())
    }

    /// Adds up the triangles of new nodes.
    fn weigh(&mut self, table: &SceneTable) {
        let nodes = self.hierarchy.nodes();
        let first = self.weights.len();
        self.weights.resize(nodes.len(), 0);
        for (number, node) in nodes.iter().enumerate().skip(first).rev() {
            if let Some(slot) = self.hierarchy.leaf(number as u32) {
                self.weights[number] = table.primitives_of(slot, MeshDetail::Level(0)).max(1);
            }
            let own = self.weights[number];
            if let Some(above) = self.weights.get_mut(node.parent as usize) {
                *above = above.saturating_add(own);
            }
        }
    }

    fn refit(&mut self, table: &SceneTable, since: u64, slots: impl Iterator<Item = u32> + Clone) {
        let untested = |slot: &u32| table.occupant(*slot).is_some() && !table.is_tested(*slot);
        let before = self.untested.len();
        self.untested.extend(slots.clone().filter(untested));
        if before > 0 || self.untested.len() > before {
            self.untested.retain(untested);
            self.untested.sort_unstable();
            self.untested.dedup();
        }
        // A slot's new entity is another one than before: remove the node, and insert a new one without history.
        let came = |slot: &u32| {
            table
                .occupant(*slot)
                .is_some_and(|one| one.added_epoch > since)
        };
        let leave = slots.clone().filter(came).map(|slot| (slot, Aabb::EMPTY));
        self.hierarchy.refit(leave);
        let tested = |slot: u32| table.occupant(slot).is_some() && table.is_tested(slot);
        self.hierarchy.refit(slots.map(|slot| match tested(slot) {
            true => (slot, bounds(table, slot)),
            false => (slot, Aabb::EMPTY),
        }));
        self.weigh(table);
    }
}

/// A leaf's box: axis-aligned, around the oriented box that queries use.
fn bounds(table: &SceneTable, slot: u32) -> Aabb {
    table.oriented(slot).bounds()
}
