//! What of a tree an outer strategy has left to be walked: the rest is met by nobody, neither leaf nor sub-tree.

use antumbra_scene::hierarchy::NONE;

use antumbra_cull::{Candidates, Tree};

/// The slots that are left, and the nodes that they lie below.
#[derive(Debug, Clone, Default)]
pub(super) struct Remaining {
    slots: Vec<bool>,
    nodes: Vec<bool>,
}

impl Remaining {
    /// Takes over what is left of a scene of so many slots.
    pub fn take(&mut self, tree: &Tree, slots: u32, left: &Candidates) {
        let hierarchy = tree.hierarchy();
        self.slots.clear();
        self.slots.resize(slots as usize, false);
        self.nodes.clear();
        self.nodes.resize(hierarchy.nodes().len(), false);
        for slot in left.inside() {
            if let Some(place) = self.slots.get_mut(*slot as usize) {
                *place = true;
            }
            let mut at = hierarchy.node_of(*slot).unwrap_or(NONE);
            while let Some(place) = self.nodes.get_mut(at as usize)
                && !std::mem::replace(place, true)
            {
                at = hierarchy.node(at).map_or(NONE, |node| node.parent);
            }
        }
    }

    /// Whether a slot is.
    pub fn has_slot(&self, slot: u32) -> bool {
        self.slots.get(slot as usize).copied().unwrap_or(false)
    }

    /// Whether anything at or below a node is.
    pub fn has_node(&self, node: u32) -> bool {
        self.nodes.get(node as usize).copied().unwrap_or(false)
    }
}
