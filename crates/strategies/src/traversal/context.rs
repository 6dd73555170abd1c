//! What a walk looks at in one frame: the scene's table, the tree over it, and the screen.

use antumbra_draw::boxes::{BoxContents, GpuBox};
use antumbra_draw::{SceneTable, ViewFrame};
use antumbra_scene::hierarchy::HierarchyNode;

use super::one_frame::TraversalSettings;
use super::queue::QueuedNode;
use super::remaining::Remaining;
use crate::occupancy::{BlockRect, PixelRect, Place, Screen};
use antumbra_cull::{Tree, Verdict, Verdicts};

/// A node that was met on the screen.
#[derive(Debug, Clone, Copy)]
pub struct VisitedNode {
    /// Its number.
    pub node: u32,
    /// The blocks under its box.
    pub rect: BlockRect,
    /// Whether all of it is in the frustum.
    pub whole: bool,
}

/// How a node is to be taken.
pub(crate) enum Visit<'a> {
    /// It is outside the frustum, or empty.
    Outside,
    /// It is too near to be asked about: visible.
    Near(VisitedNode),
    /// It is so small that it is dropped.
    Small(VisitedNode),
    /// It lies on the screen.
    OnScreen(VisitedNode, &'a HierarchyNode),
}

/// One frame's scene as a walk sees it.
pub struct TraversalContext<'a> {
    /// The scene.
    pub table: &'a SceneTable,
    /// The tree over it.
    pub tree: &'a Tree,
    /// The screen, and the eye before it.
    pub screen: Screen,
    /// Triangles below a node that is not opened.
    pub grain: u32,
    /// What an outer strategy has left of it; all, where there is none.
    left: Option<&'a Remaining>,
}

impl<'a> TraversalContext<'a> {
    /// Looks at a scene. `contents`: what the boxes of its entities hold.
    pub fn new(
        table: &'a SceneTable,
        tree: &'a Tree,
        view: &ViewFrame,
        how: &TraversalSettings,
        contents: BoxContents,
    ) -> Self {
        Self {
            table,
            tree,
            screen: Screen::new(view, how.block, contents),
            grain: how.grain,
            left: None,
        }
    }

    /// The same with no more than what an outer strategy has left.
    pub(super) fn at_what_is(self, left: Option<&'a Remaining>) -> Self {
        Self { left, ..self }
    }

    /// A node with something in it.
    pub fn node(&self, number: u32) -> Option<&'a HierarchyNode> {
        let node = self.tree.hierarchy().node(number);
        let left = self.left.is_none_or(|left| left.has_node(number));
        node.filter(|node| left && !node.bounds.is_empty())
    }

    /// Whether no outer strategy has taken a slot away.
    fn is_left(&self, slot: u32) -> bool {
        self.left.is_none_or(|left| left.has_slot(slot))
    }

    /// Whether a node is drawn or culled as one: a leaf, or so little that opening it would cost more queries than it can save.
    pub fn is_unit(&self, number: u32, node: &HierarchyNode) -> bool {
        node.is_leaf() || self.tree.weight(number) <= self.grain
    }

    /// The slots at and below a node that lie in the frustum.
    pub fn slots(&self, number: u32, whole: bool) -> impl Iterator<Item = u32> + '_ {
        let slots = self.tree.hierarchy().leaves_below(number);
        let one = self.node(number).is_some_and(HierarchyNode::is_leaf);
        slots.filter(move |slot| {
            self.is_left(*slot) && (one || whole || self.screen.sees(&self.table.bounds(*slot)))
        })
    }

    /// The slots in the frustum that no test may cull, with the blocks they lie on.
    pub fn untested(&self) -> impl Iterator<Item = (u32, BlockRect)> + '_ {
        let untested = self.tree.untested().iter();
        let untested = untested.filter(|slot| self.is_left(**slot));
        untested.filter_map(|slot| {
            let bounds = self.table.bounds(*slot);
            let pixels = match self.screen.place(&bounds, false) {
                Place::Outside => return None,
                Place::Near => self.screen.clipped(&bounds),
                Place::OnScreen { pixels, .. } => pixels,
            };
            Some((*slot, self.screen.blocks_of(&pixels)))
        })
    }

    /// Meets a node: where it lies, and how it is to be taken. `small`: pixels in width and height below which it is dropped.
    pub(crate) fn meet(&self, next: QueuedNode, small: f32) -> Visit<'a> {
        let Some(node) = self.node(next.node) else {
            return Visit::Outside;
        };
        let met = |pixels: &PixelRect, whole| VisitedNode {
            node: next.node,
            rect: self.screen.blocks_of(pixels),
            whole,
        };
        match self.screen.place(&node.bounds, next.whole) {
            Place::Outside => Visit::Outside,
            Place::Near => Visit::Near(met(&self.screen.clipped(&node.bounds), false)),
            Place::OnScreen { pixels, whole } => {
                let met = met(&pixels, whole);
                match (pixels.greatest - pixels.least).max_element() < small {
                    true => Visit::Small(met),
                    false => Visit::OnScreen(met, node),
                }
            }
        }
    }

    /// Gives all in the frustum at and below a node a verdict.
    pub fn mark(&self, met: &VisitedNode, verdict: Verdict, verdicts: &mut Verdicts) {
        for slot in self.slots(met.node, met.whole) {
            verdicts.set(slot, verdict);
        }
    }

    /// Finds all in the frustum at and below a node to be drawn; whether any of it can hide others.
    pub fn draw(
        &self,
        met: &VisitedNode,
        verdict: Verdict,
        verdicts: &mut Verdicts,
        found: &mut Vec<u32>,
    ) -> bool {
        let before = found.len();
        for slot in self.slots(met.node, met.whole) {
            verdicts.set(slot, verdict);
            // What is blended hides nothing and is drawn when all that is solid has been.
            if !self.table.is_transparent(slot) {
                found.push(slot);
            }
        }
        found.len() > before
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
