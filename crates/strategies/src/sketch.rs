//! A debugging record of a traversal: the occupancy map before the first query, and for each visited node its place on the screen, its batch
//! and its outcome. The setting `sketch` turns it on.

use antumbra_scene::Aabb;

use crate::occupancy::{BoxPlacement, Containment, OccupancyMap, PixelRect, Screen};

/// The record of one frame's traversal. Empty where the setting `sketch` is off.
#[derive(Debug, Clone, Default)]
pub struct Sketch {
    on: bool,
    block: u32,
    map: OccupancyMap,
    nodes: Vec<SketchNode>,
}

/// A visited node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SketchNode {
    /// The pixels under its box.
    pub pixels: PixelRect,
    /// The batch that queried it, from 1; 0: no query.
    pub batch: u32,
    /// Why it was drawn, opened or culled.
    pub outcome: NodeOutcome,
}

/// Why a visited node was drawn, opened or culled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NodeOutcome {
    /// It reached a free block, or an earlier answer "visible" was still valid: drawn or opened without a query.
    Free,
    /// A query found it visible.
    Visible,
    /// A query found it occluded, or an earlier answer "occluded" was still valid.
    Occluded,
}

impl NodeOutcome {
    pub(crate) fn of_query(visible: bool) -> Self {
        match visible {
            true => Self::Visible,
            false => Self::Occluded,
        }
    }
}

impl Sketch {
    /// The name under which strategies show it: `stage.shown::<Sketch>(view, Sketch::NAME)`.
    pub const NAME: &str = "sketch";

    /// Pixels along a side of a block.
    pub fn block(&self) -> u32 {
        self.block
    }

    /// The occupancy map before the first query.
    pub fn occupancy(&self) -> &OccupancyMap {
        &self.map
    }

    /// The visited nodes, in the order of their visits.
    pub fn nodes(&self) -> &[SketchNode] {
        &self.nodes
    }

    /// Starts a frame. `on`: whether the frame is recorded. `block`: pixels along a side of a block.
    pub(crate) fn begin(&mut self, on: bool, block: u32) {
        self.on = on;
        self.block = block.max(1);
        self.nodes.clear();
    }

    pub(crate) fn map(&mut self, map: &OccupancyMap) {
        if self.on {
            self.map.clone_from(map);
        }
    }

    pub(crate) fn node(
        &mut self,
        screen: &Screen,
        bounds: &Aabb,
        batch: u32,
        outcome: NodeOutcome,
    ) {
        if !self.on {
            return;
        }
        if let BoxPlacement::OnScreen { pixels, .. } = screen.place(bounds, Containment::Partial) {
            self.nodes.push(SketchNode {
                pixels,
                batch,
                outcome,
            });
        }
    }
}
