//! The settings of a traversal.

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
    /// Most neighbours in the tree that share a query. Only nodes that were hidden one frame ago share.
    pub together: u32,
    /// Triangles that a wait must be able to save, beside those that its queries cost. The waiting nodes are drawn without a query where
    /// they hold fewer. 0: every waiting node is queried.
    pub worth: u32,
    /// How long answers stay valid.
    pub lifetime: AnswerLifetime,
    /// The order in which the entities of a batch are drawn.
    pub order: DrawOrder,
    /// Whether the traversal keeps a [`Sketch`](crate::Sketch).
    pub sketch: bool,
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
        together: 1,
        worth: 0,
        lifetime: AnswerLifetime {
            visible: 0,
            occluded: 0,
            slow: 0.0,
        },
        order: DrawOrder::State,
        sketch: false,
    };
}
