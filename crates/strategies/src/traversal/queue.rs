//! The nodes still to be met, nearest corner first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::context::TraversalContext;

/// Nodes by nearness, ties by number.
#[derive(Debug, Clone, Default)]
pub(crate) struct Queue {
    /// Nearness in the upper half; below it the number, and in the last bit whether all of it is in the frustum.
    entries: BinaryHeap<Reverse<u64>>,
}

/// The nearest of them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct QueuedNode {
    pub node: u32,
    /// The square of the distance to its nearest corner.
    pub nearness: f32,
    /// Whether it lies in one that is all in the frustum.
    pub whole: bool,
}

impl Queue {
    pub fn clear(&mut self) {
        self.entries.clear();
    }

    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    pub fn push(&mut self, sight: &TraversalContext<'_>, number: u32, whole: bool) {
        if let Some(node) = sight.node(number) {
            // The bits of floats that are not negative sort as the floats do.
            let nearness = sight.screen.nearness(&node.bounds).to_bits();
            let below = number << 1 | u32::from(whole);
            let entry = u64::from(nearness) << 32 | u64::from(below);
            self.entries.push(Reverse(entry));
        }
    }

    pub fn pop(&mut self) -> Option<QueuedNode> {
        let Reverse(entry) = self.entries.pop()?;
        Some(QueuedNode {
            node: entry as u32 >> 1,
            nearness: f32::from_bits((entry >> 32) as u32),
            whole: entry & 1 != 0,
        })
    }
}
