//! Nodes that wait for a query, and the choice of those that a batch of queries is about.

use super::context::VisitedNode;
use crate::occupancy::OccupancyMap;

/// Why a node is queried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Nothing of it is drawn until its answer is there.
    Find,
    /// As `Find`; it shared a query that found a sample, and gets a query of its own.
    FindAlone,
    /// It is drawn in this frame. The answer is for the next ones.
    Retest,
}

/// A node that waits for a query.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PendingNode {
    /// The square of the distance from the eye to its nearest corner, in square metres.
    pub distance_squared: f32,
    /// The node, and its place on the screen.
    pub visited: VisitedNode,
    /// Why it is queried.
    pub purpose: Purpose,
}

impl PendingNode {
    /// The same, to get a query of its own.
    pub fn alone(&self) -> Self {
        Self {
            purpose: Purpose::FindAlone,
            ..*self
        }
    }
}

/// Chooses batches of nodes that do not cover each other (Staneker, Bartz, Strasser 2004, section 4.2).
#[derive(Debug, Clone, Default)]
pub(crate) struct BatchOrganiser {
    /// Blocks under the boxes of the present batch.
    blocks: OccupancyMap,
    /// Reused memory: the nodes that are left.
    left: Vec<PendingNode>,
}

impl BatchOrganiser {
    /// Starts a frame on a screen of this many blocks.
    pub fn begin(&mut self, [wide, high]: [u32; 2]) {
        self.blocks.reset(wide, high);
    }

    /// Moves nodes from `pending` to `batch`: the nearest ones whose boxes each reach a block that no other box of the batch covers. If these are fewer than
    /// `least`, the nearest of the others fill the batch up. The rest is left, nearest first.
    pub fn choose(
        &mut self,
        pending: &mut Vec<PendingNode>,
        batch: &mut Vec<PendingNode>,
        least: usize,
    ) {
        pending.sort_unstable_by(|a, b| {
            a.distance_squared
                .total_cmp(&b.distance_squared)
                .then(a.visited.node.cmp(&b.visited.node))
        });
        self.blocks.clear();
        self.left.clear();
        let before = batch.len();
        for node in pending.drain(..) {
            if self.blocks.has_free(node.visited.blocks) {
                self.blocks.take(node.visited.blocks);
                batch.push(node);
            } else {
                self.left.push(node);
            }
        }
        std::mem::swap(pending, &mut self.left);
        let missing = least.saturating_sub(batch.len() - before);
        batch.extend(pending.drain(..missing.min(pending.len())));
    }
}
