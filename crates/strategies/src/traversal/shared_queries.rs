//! Several nodes in one query: neighbours in the tree that were hidden when they were last queried mostly stay hidden, so one query about all
//! of their boxes mostly suffices.

use antumbra_cull::boxes::{BoxList, GpuBox};

/// Fills a box list. Consecutive hidden nodes share a query.
pub(super) struct SharedQueries<'a> {
    boxes: &'a mut BoxList,
    /// Most nodes a query.
    most: u32,
    /// Nodes in the last query.
    members: u32,
    last_was_hidden: bool,
}

impl<'a> SharedQueries<'a> {
    /// `most`: the most nodes that share a query.
    pub fn new(boxes: &'a mut BoxList, most: u32) -> Self {
        Self {
            boxes,
            most,
            members: 1,
            last_was_hidden: false,
        }
    }

    /// Adds a node's box. `was_hidden`: whether the node may share the query of its neighbour.
    pub fn push(&mut self, query_box: GpuBox, was_hidden: bool) {
        let joins = was_hidden && self.last_was_hidden && self.members < self.most;
        self.members = if joins { self.members + 1 } else { 1 };
        self.last_was_hidden = was_hidden;
        match joins {
            true => self.boxes.push_to_last(query_box),
            false => self.boxes.push(query_box),
        }
    }
}
