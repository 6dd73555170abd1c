//! The settings of a traversal.

use antumbra_cull::guard::GuardOptions;

/// How many queries are issued before their answers are waited for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QueryMode {
    /// A batch of queries. In an organised batch each box reaches a block of the screen that no other box of the batch covers. After
    /// the last organised batch all waiting nodes are queried at once.
    Batches,
    /// One query.
    Single,
}

/// The order in which the entities of a batch are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawOrder {
    /// By pipeline, texture and mesh: the fewest draws.
    State,
    /// In the order in which they were found, near entities first.
    Depth,
}

/// Which hidden nodes share a query.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sharing {
    /// Neighbours in the tree that were hidden one frame ago, at most this many a query. 1: each node has its own query.
    Neighbours(u32),
    /// The nodes of a multiquery: as many as it pays to test at once, by the probability that all of them stay hidden (CHC++).
    Multiqueries,
}

/// When a visible node is queried again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Retests {
    /// After a part of the lifetime of its answer, which depends on the node's number.
    Spread,
    /// At the end of the lifetime.
    Regular,
    /// The first time after a random part of the lifetime, and from then on at its end (CHC++).
    Randomised {
        /// The seed of the random part.
        seed: u32,
    },
}

impl Retests {
    /// Frames until a visible node is queried again. `lifetime`: the frames for which its answer holds. `frame`: the frame of the answer.
    /// `first`: whether the node was not visible before.
    pub(crate) fn frames_to_next(self, lifetime: u32, node: u32, frame: u32, first: bool) -> u32 {
        match self {
            _ if lifetime < 2 => lifetime,
            Self::Spread => lifetime - (node.wrapping_mul(GOLDEN) >> 16) % (lifetime / 2 + 1),
            Self::Randomised { seed } if first => 1 + mixed([seed, node, frame]) % lifetime,
            Self::Regular | Self::Randomised { .. } => lifetime,
        }
    }
}

/// The odd number nearest to 2^32 divided by the golden ratio: multiples of it are evenly spread.
const GOLDEN: u32 = 0x9E37_79B9;

/// A hash of numbers.
fn mixed(numbers: [u32; 3]) -> u32 {
    numbers.iter().fold(0, |hash: u32, number| {
        let hash = (hash ^ number).wrapping_add(1).wrapping_mul(GOLDEN);
        let hash = (hash ^ hash >> 15).wrapping_mul(GOLDEN);
        hash ^ hash >> 13
    })
}

/// The query geometry of a node in place of its own box: the boxes some levels below it (CHC++).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TightBoxes {
    /// Most levels below the node. 0: its own box is drawn.
    pub depth: u32,
    /// Most surface of the boxes together, as a multiple of the surface of the node's own box.
    pub surface: f32,
}

impl TightBoxes {
    /// The node's own box.
    pub const OFF: Self = Self {
        depth: 0,
        surface: 1.0,
    };
}

/// How long the answer of a query stays valid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnswerLifetime {
    /// Frames for which a visible node is drawn without another query.
    pub visible: u32,
    /// Frames for which an occluded node is culled without another query: aggressive above 0.
    pub occluded: u32,
    /// Most motion of the eye since the answer, as a part of the distance from the eye to the node.
    pub slow: f64,
}

impl AnswerLifetime {
    /// Whether the eye has moved so little that answers stay valid. `travelled`: metres since the answer. `distance_squared`: from the
    /// eye to the node, in square metres.
    pub(super) fn is_slow(&self, travelled: f64, distance_squared: f32) -> bool {
        travelled * travelled <= f64::from(distance_squared) * self.slow * self.slow
    }
}

/// The settings of a traversal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraversalSettings {
    /// How many queries are issued before their answers are waited for.
    pub queries: QueryMode,
    /// Whether a node that reaches a free block of the occupancy map is visible without a query.
    pub occupancy_map: bool,
    /// Pixels along a side of a block of the map.
    pub block: u32,
    /// A node with at most this many triangles is not opened.
    pub grain: u32,
    /// Width and height in pixels below which a sub-tree is culled; 0: none is.
    pub small: f32,
    /// The part of a batch that must be visible for the next batch to be organised too, 0..=1.
    pub least_seen: f32,
    /// Least nodes of an organised batch, where so many wait: a smaller one is filled up with nodes that its other boxes cover.
    pub batch: u32,
    /// Which hidden nodes share a query.
    pub sharing: Sharing,
    /// The query geometry of an inner node.
    pub tight: TightBoxes,
    /// Triangles that a wait must be able to save, beside those that its queries cost. The waiting nodes are drawn without a query where
    /// they hold fewer. 0: every waiting node is queried.
    pub worth: u32,
    /// How long answers stay valid.
    pub lifetime: AnswerLifetime,
    /// When a visible node is queried again.
    pub retests: Retests,
    /// The order in which the entities of a batch are drawn.
    pub order: DrawOrder,
    /// Whether the traversal keeps a [`Sketch`](crate::Sketch).
    pub sketch: bool,
    /// Frames in flight, at least 1: an answer that is used later is this many frames old.
    pub in_flight: u32,
    /// How far the eye goes a frame, for late answers that hide nothing that has come into view meanwhile.
    pub guard: GuardOptions,
}

impl TraversalSettings {
    /// The traversal of the paper, without additions.
    pub const PAPER: Self = Self {
        queries: QueryMode::Batches,
        occupancy_map: true,
        block: 4,
        grain: 0,
        small: 0.0,
        least_seen: 0.0,
        batch: 1,
        sharing: Sharing::Neighbours(1),
        tight: TightBoxes::OFF,
        worth: 0,
        lifetime: AnswerLifetime {
            visible: 0,
            occluded: 0,
            slow: 0.0,
        },
        retests: Retests::Spread,
        order: DrawOrder::State,
        sketch: false,
        in_flight: 1,
        guard: GuardOptions::OFF,
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many of a thousand nodes are queried after 0, 1, .. 5 frames.
    fn first_tests(retests: Retests) -> [u32; 6] {
        let mut after = [0; 6];
        for node in 0..1000 {
            after[retests.frames_to_next(5, node, 7, true) as usize] += 1;
        }
        after
    }

    #[test]
    fn random_first_tests_are_spread_over_all_frames() {
        let [none, each @ ..] = first_tests(Retests::Randomised { seed: 1 });
        assert_eq!((none, each.iter().sum::<u32>()), (0, 1000));
        assert!(
            each.iter().all(|nodes| (150..250).contains(nodes)),
            "{each:?}"
        );
        assert_eq!(first_tests(Retests::Regular), [0, 0, 0, 0, 0, 1000]);
    }

    #[test]
    fn later_tests_are_regular_and_seeds_differ() {
        let next =
            |seed, node, first| Retests::Randomised { seed }.frames_to_next(5, node, 7, first);
        assert!((0..1000).all(|node| next(1, node, false) == 5));
        assert!((0..1000).all(|node| next(1, node, true) == next(1, node, true)));
        let same = (0..1000).filter(|node| next(1, *node, true) == next(2, *node, true));
        assert!((100..300).contains(&same.count()));
    }

    #[test]
    fn without_a_lifetime_every_frame_has_a_query() {
        for retests in [
            Retests::Spread,
            Retests::Regular,
            Retests::Randomised { seed: 3 },
        ] {
            assert!((0..100).all(|node| retests.frames_to_next(0, node, 9, true) == 0));
        }
    }
}
