//! How many hidden nodes are tested by one query.
//!
//! Mattausch, Bittner, Wimmer, *CHC++: Coherent Hierarchical Culling Revisited*, 2008 (multiqueries): the longer a node has been
//! hidden, the more probably it stays so. A query about several nodes saves the others where all stay hidden, and is wasted where one does not.

use super::settings::Sharing;

/// The nodes of one query so far.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Multiquery {
    nodes: u32,
    /// The probability that all of them stay hidden.
    stays_hidden: f64,
    shares: bool,
}

/// Frames after which the probability no longer grows. Nodes of one probability are then in the order of the tree, and so near each other.
const SETTLED: u32 = 10;

impl Multiquery {
    /// The place of a node in the order in which nodes join queries: those that most probably stay hidden first.
    pub fn place(hidden_for: u32) -> u32 {
        SETTLED.saturating_sub(hidden_for)
    }

    /// Adds the next node. Returns whether it joins the query of the nodes before it; if not, it begins a query. `hidden_for`: frames for which the node
    /// has been hidden; 0: it shares no query.
    pub fn joins(&mut self, sharing: Sharing, hidden_for: u32) -> bool {
        let alone = Self {
            nodes: 1,
            stays_hidden: stays_hidden(hidden_for),
            shares: hidden_for > 0,
        };
        let both = Self {
            nodes: self.nodes + 1,
            stays_hidden: self.stays_hidden * alone.stays_hidden,
            shares: true,
        };
        let pays = match sharing {
            Sharing::Neighbours(most) => self.nodes < most,
            Sharing::Multiqueries => both.value() > self.value(),
        };
        let joins = self.nodes > 0 && self.shares && alone.shares && pays;
        *self = if joins { both } else { alone };
        joins
    }

    /// Nodes that the query decides, for each query that it costs: itself, and one a node where any of several is visible.
    fn value(&self) -> f64 {
        let nodes = f64::from(self.nodes);
        match self.nodes {
            0 | 1 => nodes,
            _ => nodes / (1.0 + (1.0 - self.stays_hidden) * nodes),
        }
    }
}

/// The probability that a node stays hidden which has been so for this many frames: the paper's fit of what it measured.
fn stays_hidden(frames: u32) -> f64 {
    0.99 - 0.7 * (-f64::from(frames.min(SETTLED))).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nodes of each query, where `nodes` of them have been hidden for this many frames.
    fn sizes(sharing: Sharing, nodes: u32, hidden_for: u32) -> Vec<u32> {
        let (mut query, mut sizes) = (Multiquery::default(), Vec::new());
        for _ in 0..nodes {
            match (query.joins(sharing, hidden_for), sizes.last_mut()) {
                (true, Some(last)) => *last += 1,
                _ => sizes.push(1),
            }
        }
        sizes
    }

    #[test]
    fn the_longer_nodes_are_hidden_the_more_of_them_share_a_query() {
        let multiqueries = |hidden_for| sizes(Sharing::Multiqueries, 24, hidden_for);
        assert_eq!(multiqueries(0), [1; 24]);
        // By the formula one frame gives 0.73 a node: three nodes are worth 1.06 queries, four 1.04.
        assert_eq!(multiqueries(1), [3; 8]);
        // 0.895: four are worth 1.65, five 1.60.
        assert_eq!(multiqueries(2), [4; 6]);
        // 0.99: eleven are worth 5.11, twelve 5.07.
        assert_eq!(multiqueries(40), [11, 11, 2]);
    }

    #[test]
    fn a_node_that_shares_no_query_ends_one() {
        let mut query = Multiquery::default();
        let joins =
            [20, 20, 0, 20, 20].map(|hidden_for| query.joins(Sharing::Multiqueries, hidden_for));
        assert_eq!(joins, [false, true, false, false, true]);
    }

    #[test]
    fn neighbours_share_whatever_their_history() {
        assert_eq!(sizes(Sharing::Neighbours(8), 20, 1), [8, 8, 4]);
        assert_eq!(sizes(Sharing::Neighbours(1), 3, 9), [1; 3]);
        assert_eq!(sizes(Sharing::Neighbours(8), 3, 0), [1; 3]);
    }

    #[test]
    fn those_which_most_probably_stay_hidden_come_first() {
        let places = [0, 1, 5, 10, 200].map(Multiquery::place);
        assert_eq!(places, [10, 9, 5, 0, 0]);
    }
}
