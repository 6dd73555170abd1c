//! What a hierarchical strategy can leave for whoever debugs it: the map as it was when the first question was asked, and where every node lay
//! that was met, in which batch, with which answer.

use antumbra_scene::Aabb;

use crate::occupancy::{OccupancyMap, PixelRect, Place, Screen};

/// A walk's sketch. Empty where none was asked for.
#[derive(Debug, Clone, Default)]
pub struct Sketch {
    on: bool,
    block: u32,
    map: OccupancyMap,
    nodes: Vec<SketchNode>,
}

/// A node that was met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SketchNode {
    /// The pixels under its box.
    pub pixels: PixelRect,
    /// The batch it was asked about in, from 1; 0: it was not asked about.
    pub batch: u32,
    /// What became of it.
    pub outcome: NodeOutcome,
}

/// What became of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NodeOutcome {
    /// It reached a free block, or was remembered as visible: drawn or opened without a query.
    Free,
    /// A query found it visible.
    Visible,
    /// A query found it occluded, or it was remembered as such.
    Occluded,
}

impl Sketch {
    /// The name that strategies show it by: `stage.shown::<Sketch>(view, Sketch::NAME)`.
    pub const NAME: &str = "sketch";

    /// Pixels along a side of a block.
    pub fn block(&self) -> u32 {
        self.block
    }

    /// The map as it was before the first question.
    pub fn occupancy(&self) -> &OccupancyMap {
        &self.map
    }

    /// The nodes that were met, in that order.
    pub fn nodes(&self) -> &[SketchNode] {
        &self.nodes
    }

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
        if let Place::OnScreen { pixels, .. } = screen.place(bounds, false) {
            self.nodes.push(SketchNode {
                pixels,
                batch,
                outcome,
            });
        }
    }
}
