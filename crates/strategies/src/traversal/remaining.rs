//! The part of a tree that an outer strategy has left to an inner one. The traversal skips all other leaves and sub-trees.

use antumbra_scene::hierarchy::NONE;

use antumbra_cull::{Candidates, Tree};

/// The remaining slots, and the nodes above them.
#[derive(Debug, Clone, Default)]
pub(super) struct Remaining {
    slots: Vec<bool>,
    nodes: Vec<bool>,
}

impl Remaining {
    /// Takes over the remaining candidates of a scene of `slots` slots.
    pub fn update(&mut self, tree: &Tree, slots: u32, candidates: &Candidates) {
        let hierarchy = tree.hierarchy();
        self.slots.clear();
        self.slots.resize(slots as usize, false);
        self.nodes.clear();
        self.nodes.resize(hierarchy.nodes().len(), false);
        for slot in candidates.inside() {
            if let Some(remains) = self.slots.get_mut(*slot as usize) {
                *remains = true;
            }
            let mut at = hierarchy.node_of(*slot).unwrap_or(NONE);
            while let Some(remains) = self.nodes.get_mut(at as usize)
                && !std::mem::replace(remains, true)
            {
                at = hierarchy.node(at).map_or(NONE, |node| node.parent);
            }
        }
    }

    /// Whether a slot remains.
    pub fn has_slot(&self, slot: u32) -> bool {
        self.slots.get(slot as usize).copied().unwrap_or(false)
    }

    /// Whether any slot at or below a node remains.
    pub fn has_node(&self, node: u32) -> bool {
        self.nodes.get(node as usize).copied().unwrap_or(false)
    }
}
