//! The frontier of a traversal: the nodes still to be visited, the slots found so far, and the blocks of the screen they cover.

use super::context::{QueuedNode, TraversalContext, VisitedNode};
use super::queue::NodeQueue;
use crate::occupancy::{BlockRect, Containment, OccupancyMap};
use antumbra_cull::{Verdict, Verdicts};

/// The frontier of a traversal.
#[derive(Debug, Clone, Default)]
pub(crate) struct Frontier {
    queue: NodeQueue,
    /// Blocks that may be covered by what is drawn.
    pub covered: OccupancyMap,
    /// Slots to be drawn.
    pub found: Vec<u32>,
}

impl Frontier {
    /// Starts a frame: draws all slots that no test may cull, and queues the roots.
    pub fn begin(&mut self, context: &TraversalContext<'_>, verdicts: &mut Verdicts) {
        self.queue.clear();
        self.found.clear();
        let [wide, high] = context.screen.blocks();
        self.covered.reset(wide, high);
        for (slot, blocks) in context.untested() {
            verdicts.set(slot, Verdict::Untested);
            self.found.push(slot);
            self.covered.take(blocks);
        }
        for root in context.tree.hierarchy().roots() {
            self.queue.push(context, root, Containment::Partial);
        }
    }

    /// Takes the nearest node that is still to be visited.
    pub fn next(&mut self) -> Option<QueuedNode> {
        self.queue.pop()
    }

    /// Whether every node has been visited and every found slot has been drawn.
    pub fn is_done(&self) -> bool {
        self.queue.is_empty() && self.found.is_empty()
    }

    /// Whether at least one of these blocks is covered by nothing drawn.
    pub fn is_free(&self, blocks: BlockRect) -> bool {
        self.covered.has_free(blocks)
    }

    /// Handles a visible node: draws it if it is a unit, otherwise queues its children.
    pub fn expand(
        &mut self,
        context: &TraversalContext<'_>,
        visited: &VisitedNode,
        verdict: Verdict,
        verdicts: &mut Verdicts,
    ) {
        match context.node(visited.node) {
            Some(node) if !context.is_unit(visited.node, node) => {
                for child in node.children() {
                    self.queue.push(context, child, visited.containment);
                }
            }
            _ => self.draw(context, visited, verdict, verdicts),
        }
    }

    /// Draws all slots at and below a node.
    pub fn draw(
        &mut self,
        context: &TraversalContext<'_>,
        visited: &VisitedNode,
        verdict: Verdict,
        verdicts: &mut Verdicts,
    ) {
        if context.draw(visited, verdict, verdicts, &mut self.found) {
            self.covered.take(visited.blocks);
        }
    }
}
