//! A tree kept in step with what moves, comes and goes: boxes are fitted anew from the leaves up; who comes hangs loose; and when too much
//! has changed it says so, for whoever owns it to make it anew.

use super::{Hierarchy, HierarchyNode, NONE};
use crate::bounds::Aabb;

/// Where more than this part of the nodes are dirty, looking at all of them in order costs less than keeping the dirty ones sorted.
const SWEEPS: usize = 32;

impl Hierarchy {
    /// Gives some leaves their boxes of now, and fits every box above them. A leaf that is not in the tree comes in, loose; one whose box is
    /// empty is taken out.
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
                        self.order[first_leaf] = NONE;
                        self.place(leaf, NONE);
                        self.gone += 1;
                    }
                    self.dirty.push(parent);
                }
            }
        }
        self.fit();
    }

    /// Whether so much came, went or moved that a tree made anew would be a better one.
    #[must_use]
    pub fn needs_rebuild(&self) -> bool {
        let loose = self.nodes.len() as u32 - self.loose_from;
        let changed = loose + self.gone;
        (changed > 64 && changed > self.loose_from / 8) || self.area > self.area_when_made * 2.0
    }

    fn insert(&mut self, leaf: u32, bounds: Aabb) {
        let number = self.nodes.len() as u32;
        self.nodes.push(HierarchyNode {
            bounds,
            parent: NONE,
            first_child: 0,
            children: 0,
            first_leaf: self.order.len() as u32,
            leaves: 1,
        });
        self.order.push(leaf);
        self.place(leaf, number);
    }

    pub(super) fn place(&mut self, leaf: u32, node: u32) {
        if self.node_of.len() <= leaf as usize {
            self.node_of.resize(leaf as usize + 1, NONE);
        }
        self.node_of[leaf as usize] = node;
    }

    /// Fits the dirty boxes and those above them, the last ones first: no node comes before its parent.
    fn fit(&mut self) {
        if self.dirty.len() > self.nodes.len() / SWEEPS {
            self.dirty.clear();
            for number in (0..self.loose_from).rev() {
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

    /// Fits an inner node's box around its children's; whether it is another one now.
    fn fit_node(&mut self, number: u32) -> bool {
        let node = self.nodes[number as usize];
        let children = &self.nodes[node.first_child as usize..][..node.children as usize];
        let around = children
            .iter()
            .fold(Aabb::EMPTY, |all, child| all.union(&child.bounds));
        if around == node.bounds {
            return false;
        }
        self.area += area(&around) - area(&node.bounds);
        self.nodes[number as usize].bounds = around;
        true
    }
}

/// Half the surface of a box in square metres; 0 of an empty one.
pub(super) fn area(bounds: &Aabb) -> f64 {
    if bounds.is_empty() {
        return 0.0;
    }
    let size = bounds.max - bounds.min;
    size.x * size.y + size.y * size.z + size.z * size.x
}
