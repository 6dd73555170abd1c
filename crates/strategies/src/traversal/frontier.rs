//! How far a walk has come: who is still to be met, what has been found, and where on the screen that lies.

use super::context::{TraversalContext, VisitedNode};
use super::queue::{Queue, QueuedNode};
use crate::occupancy::{BlockRect, OccupancyMap};
use antumbra_cull::{Verdict, Verdicts};

/// The front of a walk.
#[derive(Debug, Clone, Default)]
pub(super) struct Frontier {
    queue: Queue,
    /// Blocks that something drawn may lie on.
    pub drawn_on: OccupancyMap,
    /// Slots to be drawn.
    pub found: Vec<u32>,
}

impl Frontier {
    /// Begins at the roots, with all that no test may cull drawn.
    pub fn begin(&mut self, sight: &TraversalContext<'_>, verdicts: &mut Verdicts) {
        self.queue.clear();
        self.found.clear();
        let [wide, high] = sight.screen.blocks();
        self.drawn_on.reset(wide, high);
        for (slot, rect) in sight.untested() {
            verdicts.set(slot, Verdict::Untested);
            self.found.push(slot);
            self.drawn_on.take(rect);
        }
        for root in sight.tree.hierarchy().roots() {
            self.queue.push(sight, root, false);
        }
    }

    /// The nearest of those still to be met.
    pub fn next(&mut self) -> Option<QueuedNode> {
        self.queue.pop()
    }

    /// Whether all have been met and drawn.
    pub fn is_over(&self) -> bool {
        self.queue.is_empty() && self.found.is_empty()
    }

    /// Whether nothing drawn lies on some of these blocks.
    pub fn is_free(&self, rect: BlockRect) -> bool {
        self.drawn_on.has_free(rect)
    }

    /// Draws a unit, opens what is none.
    pub fn see(
        &mut self,
        sight: &TraversalContext<'_>,
        met: &VisitedNode,
        verdict: Verdict,
        verdicts: &mut Verdicts,
    ) {
        match sight.node(met.node) {
            Some(node) if !sight.is_unit(met.node, node) => {
                for child in node.children() {
                    self.queue.push(sight, child, met.whole);
                }
            }
            _ => self.draw(sight, met, verdict, verdicts),
        }
    }

    /// Draws all at and below a node.
    pub fn draw(
        &mut self,
        sight: &TraversalContext<'_>,
        met: &VisitedNode,
        verdict: Verdict,
        verdicts: &mut Verdicts,
    ) {
        if sight.draw(met, verdict, verdicts, &mut self.found) {
            self.drawn_on.take(met.rect);
        }
    }
}
