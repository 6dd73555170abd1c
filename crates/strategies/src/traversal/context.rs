//! What a traversal reads in one frame: the scene's table, the tree over it, and the screen.

use antumbra_cull::boxes::{BoxContents, GpuBox};
use antumbra_cull::{SceneTable, Tree, Verdict, Verdicts, ViewFrame};
use antumbra_scene::hierarchy::HierarchyNode;

use super::remaining::Remaining;
use super::settings::TraversalSettings;
use crate::occupancy::{BlockRect, BoxPlacement, Containment, PixelRect, Screen};

/// A node taken from the queue.
#[derive(Debug, Clone, Copy)]
pub(crate) struct QueuedNode {
    pub node: u32,
    /// The square of the distance from the eye to the nearest corner of its box, in square metres.
    pub distance_squared: f32,
    /// How much of its parent lies in the frustum.
    pub containment: Containment,
}

/// A node that the traversal reached, with its place on the screen.
#[derive(Debug, Clone, Copy)]
pub struct VisitedNode {
    /// The node's number in the hierarchy.
    pub node: u32,
    /// The blocks of the occupancy map under its box.
    pub blocks: BlockRect,
    /// How much of its box lies in the frustum.
    pub containment: Containment,
}

/// What a traversal finds when it reaches a node.
pub(crate) enum Visit<'a> {
    /// The node is outside the frustum, or empty.
    Outside,
    /// The node is too near to be queried: visible.
    Near(VisitedNode),
    /// The node is so small on the screen that it is culled.
    Small(VisitedNode),
    /// The node lies on the screen.
    OnScreen(VisitedNode, &'a HierarchyNode),
}

/// One frame's scene, tree and screen.
pub struct TraversalContext<'a> {
    /// The scene.
    pub table: &'a SceneTable,
    /// The tree over it.
    pub tree: &'a Tree,
    /// The screen and the eye.
    pub screen: Screen,
    /// A node with at most this many triangles is not opened.
    pub grain: u32,
    /// What an outer strategy has left of the tree; `None`: all of it.
    remaining: Option<&'a Remaining>,
}

impl<'a> TraversalContext<'a> {
    /// The context of one frame. `contents`: what the boxes of the scene's entities hold.
    pub fn new(
        table: &'a SceneTable,
        tree: &'a Tree,
        view: &ViewFrame,
        settings: &TraversalSettings,
        contents: BoxContents,
    ) -> Self {
        Self {
            table,
            tree,
            screen: Screen::new(view, settings.block, contents),
            grain: settings.grain,
            remaining: None,
        }
    }

    /// Restricts the traversal to what an outer strategy has left.
    pub(super) fn restricted_to(self, remaining: Option<&'a Remaining>) -> Self {
        Self { remaining, ..self }
    }

    /// A node of the tree; `None` where it is empty or an outer strategy has judged all of it.
    pub fn node(&self, number: u32) -> Option<&'a HierarchyNode> {
        let node = self.tree.hierarchy().node(number);
        let remains = self
            .remaining
            .is_none_or(|remaining| remaining.has_node(number));
        node.filter(|node| remains && !node.bounds.is_empty())
    }

    fn remains(&self, slot: u32) -> bool {
        self.remaining
            .is_none_or(|remaining| remaining.has_slot(slot))
    }

    /// Whether a node is drawn or culled as a whole: a leaf, or a node of so few triangles that opening it costs more queries than it can save.
    pub fn is_unit(&self, number: u32, node: &HierarchyNode) -> bool {
        node.is_leaf() || self.tree.weight(number) <= self.grain
    }

    /// The slots at and below a node that lie in the frustum.
    pub fn slots(&self, number: u32, containment: Containment) -> impl Iterator<Item = u32> + '_ {
        let slots = self.tree.hierarchy().leaves_below(number);
        let is_leaf = self.node(number).is_some_and(HierarchyNode::is_leaf);
        let all = is_leaf || containment == Containment::Inside;
        slots.filter(move |slot| {
            self.remains(*slot) && (all || self.screen.sees(&self.table.bounds(*slot)))
        })
    }

    /// The slots in the frustum that no test may cull, each with the blocks under its box.
    pub fn untested(&self) -> impl Iterator<Item = (u32, BlockRect)> + '_ {
        let untested = self.tree.untested().iter();
        let untested = untested.filter(|slot| self.remains(**slot));
        untested.filter_map(|slot| {
            let bounds = self.table.bounds(*slot);
            let pixels = match self.screen.place(&bounds, Containment::Partial) {
                BoxPlacement::Outside => return None,
                BoxPlacement::Near => self.screen.clipped(&bounds),
                BoxPlacement::OnScreen { pixels, .. } => pixels,
            };
            Some((*slot, self.screen.blocks_of(&pixels)))
        })
    }

    /// Finds where a node lies. `small`: width and height in pixels below which it is culled.
    pub(crate) fn visit(&self, next: QueuedNode, small: f32) -> Visit<'a> {
        let Some(node) = self.node(next.node) else {
            return Visit::Outside;
        };
        let visited = |pixels: &PixelRect, containment| VisitedNode {
            node: next.node,
            blocks: self.screen.blocks_of(pixels),
            containment,
        };
        match self.screen.place(&node.bounds, next.containment) {
            BoxPlacement::Outside => Visit::Outside,
            BoxPlacement::Near => {
                let pixels = self.screen.clipped(&node.bounds);
                Visit::Near(visited(&pixels, Containment::Partial))
            }
            BoxPlacement::OnScreen {
                pixels,
                containment,
            } => {
                let visited = visited(&pixels, containment);
                match (pixels.greatest - pixels.least).max_element() < small {
                    true => Visit::Small(visited),
                    false => Visit::OnScreen(visited, node),
                }
            }
        }
    }

    /// Gives all slots in the frustum at and below a node a verdict.
    pub fn mark(&self, visited: &VisitedNode, verdict: Verdict, verdicts: &mut Verdicts) {
        for slot in self.slots(visited.node, visited.containment) {
            verdicts.set(slot, verdict);
        }
    }

    /// Gives all slots in the frustum at and below a node a verdict that draws them, and adds the opaque ones to `found`. Returns whether
    /// it added any: only these can hide other nodes.
    pub fn draw(
        &self,
        visited: &VisitedNode,
        verdict: Verdict,
        verdicts: &mut Verdicts,
        found: &mut Vec<u32>,
    ) -> bool {
        let before = found.len();
        for slot in self.slots(visited.node, visited.containment) {
            verdicts.set(slot, verdict);
            // A transparent entity hides nothing and is drawn after all opaque ones.
            if !self.table.is_transparent(slot) {
                found.push(slot);
            }
        }
        found.len() > before
    }

    /// The box that a query about a node draws; `None` where the GPU cannot hold it.
    pub fn query_box(&self, number: u32) -> Option<GpuBox> {
        let hierarchy = self.tree.hierarchy();
        let widening = self.screen.widening();
        match hierarchy.leaf(number) {
            Some(slot) => widening.oriented(&self.table.oriented(slot)),
            None => widening.aligned(&hierarchy.node(number)?.bounds),
        }
    }
}
