//! Several nodes in one query: nodes that were hidden when they were last queried mostly stay hidden, so one query about the boxes of all of
//! them mostly suffices.

use antumbra_cull::boxes::{BoxList, GpuBox};

use super::context::TraversalContext;
use super::multiquery::Multiquery;
use super::settings::{Sharing, TraversalSettings};
use super::tight_boxes::TightNodes;

/// A node to be queried.
#[derive(Debug, Clone, Copy)]
pub(crate) struct QuerySubject {
    /// The node's number.
    pub node: u32,
    /// The frames for which it has been hidden. 0: it shares no query.
    pub hidden_for: u32,
}

impl QuerySubject {
    /// The place in the order in which nodes are pushed, so that those which may share a query are neighbours.
    pub fn place(&self, sharing: Sharing) -> (u32, u32) {
        match sharing {
            // Siblings, and children of siblings, are neighbours by number.
            Sharing::Neighbours(_) => (0, self.node),
            Sharing::Multiqueries => (Multiquery::place(self.hidden_for), self.node),
        }
    }
}

/// The queries of a batch. They are kept while their answers are awaited.
#[derive(Debug, Clone, Default)]
pub(crate) struct SharedQueries {
    /// For each query, the end of its nodes.
    ends: Vec<u32>,
    /// Nodes of all queries.
    nodes: u32,
    /// The nodes of the last query.
    members: Multiquery,
    geometry: TightNodes,
    boxes: Vec<GpuBox>,
}

impl SharedQueries {
    /// Drops all queries. The memory is kept.
    pub fn clear(&mut self) {
        self.ends.clear();
        self.nodes = 0;
        self.members = Multiquery::default();
    }

    /// For each query, the end of its nodes, in the order in which they were pushed.
    pub fn ends(&self) -> &[u32] {
        &self.ends
    }

    /// Each query's nodes, of all that were pushed in this order, with its answer. A query without one counts as visible: its nodes must not be culled.
    pub fn answered<'a, T>(
        &'a self,
        pushed: &'a [T],
        answers: impl Iterator<Item = bool> + 'a,
    ) -> impl Iterator<Item = (&'a [T], bool)> + 'a {
        let answers = answers.chain(std::iter::repeat(true));
        let mut first = 0;
        self.ends.iter().zip(answers).map(move |(end, visible)| {
            let end = *end as usize;
            let members = pushed.get(first..end).unwrap_or_default();
            first = end;
            (members, visible)
        })
    }

    /// Adds a node, and its query geometry to `list`. Returns whether the GPU can hold its geometry; a node of which this is false must be
    /// drawn.
    pub fn push(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        subject: QuerySubject,
        list: &mut BoxList,
    ) -> bool {
        self.boxes.clear();
        for node in (self.geometry).below(|node| context.node(node), subject.node, settings.tight) {
            let Some(query_box) = context.query_box(*node) else {
                return false;
            };
            self.boxes.push(query_box);
        }
        let Some((first, others)) = self.boxes.split_first() else {
            return false;
        };
        self.nodes += 1;
        if self.members.joins(settings.sharing, subject.hidden_for) {
            self.ends.pop();
            list.push_to_last(*first);
        } else {
            list.push(*first);
        }
        self.ends.push(self.nodes);
        for other in others {
            list.push_to_last(*other);
        }
        true
    }
}
