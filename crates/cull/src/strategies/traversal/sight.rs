//! What a walk looks at in one frame: the scene's table, the tree over it, and the screen.

use antumbra_draw::boxes::GpuBox;
use antumbra_draw::{Class, SceneTable, ViewFrame};
use antumbra_scene::Topology;
use antumbra_scene::hierarchy::HierarchyNode;

use crate::occupancy::Screen;
use crate::tree::Tree;

/// One frame's scene as a walk sees it.
pub(crate) struct Sight<'a> {
    pub table: &'a SceneTable,
    pub tree: &'a Tree,
    pub screen: Screen,
    /// Triangles below a node that is not opened.
    pub grain: u32,
}

impl<'a> Sight<'a> {
    pub fn new(
        table: &'a SceneTable,
        tree: &'a Tree,
        view: &ViewFrame,
        block: u32,
        grain: u32,
    ) -> Self {
        let thin = |class: Class| class.topology() != Topology::Triangles;
        let thin = table.batches().iter().any(|batch| thin(batch.class));
        Self {
            table,
            tree,
            screen: Screen::new(view, block, thin),
            grain,
        }
    }

    pub fn node(&self, number: u32) -> Option<&'a HierarchyNode> {
        let node = self.tree.hierarchy().node(number);
        node.filter(|node| !node.bounds.is_empty())
    }

    /// Whether a node is drawn or culled as one: a leaf, or so little that opening it would cost more queries than it can save.
    pub fn is_unit(&self, number: u32, node: &HierarchyNode) -> bool {
        node.is_leaf() || self.tree.weight(number) <= self.grain
    }

    /// The slots at and below a node that lie in the frustum.
    pub fn slots(&self, number: u32, whole: bool) -> impl Iterator<Item = u32> + '_ {
        let slots = self.tree.hierarchy().leaves_below(number);
        slots.filter(move |slot| whole || self.screen.sees(&self.table.bounds(*slot)))
    }

    /// The box to ask about a node with; `None` where the GPU cannot hold it.
    pub fn question(&self, number: u32) -> Option<GpuBox> {
        let hierarchy = self.tree.hierarchy();
        let widening = self.screen.widening();
        match hierarchy.leaf(number) {
            Some(slot) => widening.oriented(&self.table.oriented(slot)),
            None => widening.aligned(&hierarchy.node(number)?.bounds),
        }
    }
}
