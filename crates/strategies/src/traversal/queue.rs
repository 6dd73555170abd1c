//! The priority queue of a traversal: the node with the nearest corner first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::context::{QueuedNode, TraversalContext};
use crate::occupancy::Containment;

/// Nodes by the distance of their nearest corner, ties by number.
#[derive(Debug, Clone, Default)]
pub(crate) struct NodeQueue {
    /// The bits of the squared distance in the upper half. In the lower half the number, and in the last bit the parent's containment.
    entries: BinaryHeap<Reverse<u64>>,
}

impl NodeQueue {
    pub fn clear(&mut self) {
        self.entries.clear();
    }

    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Adds a node. `parent`: how much of its parent lies in the frustum.
    pub fn push(&mut self, context: &TraversalContext<'_>, number: u32, parent: Containment) {
        if let Some(node) = context.node(number) {
            // The bits of floats that are not negative sort as the floats do.
            let distance = context
                .screen
                .nearest_corner_distance_squared(&node.bounds)
                .to_bits();
            let below = number << 1 | u32::from(parent == Containment::Inside);
            let entry = u64::from(distance) << 32 | u64::from(below);
            self.entries.push(Reverse(entry));
        }
    }

    /// Takes the nearest node.
    pub fn pop(&mut self) -> Option<QueuedNode> {
        let Reverse(entry) = self.entries.pop()?;
        Some(QueuedNode {
            node: entry as u32 >> 1,
            distance_squared: f32::from_bits((entry >> 32) as u32),
            containment: match entry & 1 {
                0 => Containment::Partial,
                _ => Containment::Inside,
            },
        })
    }
}
