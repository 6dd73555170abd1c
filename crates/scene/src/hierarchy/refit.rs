//! Updating a hierarchy after changes.
//!
//! Boxes are refitted from the leaves up. An added leaf has no parent. When too much has changed,
//! [`Hierarchy::needs_rebuild`] reports it, and the owner builds a new tree.

use super::input::NONE;
use super::tree::{Hierarchy, HierarchyNode};
use crate::bounds::Aabb;

/// The divisor of the node count. Above `nodes / SWEEPS` dirty nodes, a sweep over all nodes costs less than a sorted
/// queue.
const SWEEPS: usize = 32;

impl Hierarchy {
    /// Sets the boxes of some leaves and refits every box above them. A leaf that is not in the tree is added without
    /// a parent. A leaf whose box is empty is removed.
    pub fn refit(&mut self, leaves: impl IntoIterator<Item = (u32, Aabb)>) {
        for (leaf, bounds) in leaves {
            match (self.node_of(leaf), bounds.is_empty()) {
                (None, true) => {}
                (None, false) => self.insert(leaf, bounds),
                (Some(node), taken_out) => {
                    let place = &mut self.nodes[node as usize];
                    let parent = place.parent;
                    let first_leaf = place.first_leaf as usize;
                    place.bounds = bounds;
                    if taken_out {
                        place.bounds = Aabb::EMPTY;
                        self.leaf_order[first_leaf] = NONE;
                        self.set_node(leaf, NONE);
                        self.removed += 1;
                    }
                    self.dirty.push(parent);
                }
            }
        }
        self.fit();
    }

    /// Whether so many leaves were added, removed or moved that a rebuilt tree would be better.
    #[must_use]
    pub fn needs_rebuild(&self) -> bool {
        let unattached = self.nodes.len() as u32 - self.unattached_from;
        let changed = unattached + self.removed;
        (changed > 64 && changed > self.unattached_from / 8) || self.area > self.built_area * 2.0
    }

    fn insert(&mut self, leaf: u32, bounds: Aabb) {
        let number = self.nodes.len() as u32;
        self.nodes.push(HierarchyNode {
            bounds,
            parent: NONE,
            first_child: 0,
            children: 0,
            first_leaf: self.leaf_order.len() as u32,
            leaves: 1,
        });
        self.leaf_order.push(leaf);
        self.set_node(leaf, number);
    }

    pub(super) fn set_node(&mut self, leaf: u32, node: u32) {
        if self.node_of.len() <= leaf as usize {
            self.node_of.resize(leaf as usize + 1, NONE);
        }
        self.node_of[leaf as usize] = node;
    }

    /// Refits the dirty boxes and those above them, in descending order of number. Every node follows its parent.
    fn fit(&mut self) {
        if self.dirty.len() > self.nodes.len() / SWEEPS {
            self.dirty.clear();
            for number in (0..self.unattached_from).rev() {
                if !self.nodes[number as usize].is_leaf() {
                    self.fit_node(number);
                }
            }
            return;
        }
        let mut dirty: std::collections::BinaryHeap<u32> =
            self.dirty.drain(..).filter(|node| *node != NONE).collect();
        while let Some(number) = dirty.pop() {
            while dirty.peek() == Some(&number) {
                dirty.pop();
            }
            let parent = self.nodes[number as usize].parent;
            if self.fit_node(number) && parent != NONE {
                dirty.push(parent);
            }
        }
    }

    /// Refits an inner node's box around its children. Returns whether the box has changed.
    fn fit_node(&mut self, number: u32) -> bool {
        let node = self.nodes[number as usize];
        let children = &self.nodes[node.first_child as usize..][..node.children as usize];
        let around = children
            .iter()
            .fold(Aabb::EMPTY, |all, child| all.union(&child.bounds));
        if around == node.bounds {
            return false;
        }
        self.area += around.half_area() - node.bounds.half_area();
        self.nodes[number as usize].bounds = around;
        true
    }
}
