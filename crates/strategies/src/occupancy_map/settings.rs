//! The settings of both strategies with an occupancy map: fields and parameters (key, range, unit, description).

use antumbra_cull::guard::GuardOptions;
use antumbra_cull::{Parameter, shortest};
use antumbra_scene::hierarchy::HierarchyShape;

use crate::traversal::{
    AnswerLifetime, DrawOrder, QueryMode, Retests, Sharing, TightBoxes, TraversalSettings,
};

/// The settings of both strategies.
#[derive(Debug, Clone, PartialEq)]
pub struct OccupancySettings {
    /// How the inner nodes of the tree are made.
    pub tree: HierarchyShape,
    /// Pixels along a side of a block of the map: 1 to 256.
    pub block: u32,
    /// A node with at most this many triangles is not opened: its children would cost more queries than they can save.
    pub grain: u32,
    /// Width and height in pixels below which a sub-tree is culled (aggressive); 0: none is.
    pub small: f32,
    /// The part of a batch, 0..=1, that must be visible for the next batch to be organised too. Below it, little new was drawn that could hide
    /// the waiting nodes. 0: every batch is organised, as in the paper.
    pub least_seen: f32,
    /// Most neighbours in the tree, hidden one frame ago, that share a query. Where it finds a sample, each gets a query of its own. 1: no
    /// sharing, as in the paper.
    pub together: u32,
    /// Triangles that a wait must be able to save, beside 190 a query. Where all waiting nodes together hold no more, they are drawn without a
    /// query. 0: every waiting node is queried, as in the paper.
    pub worth: u32,
    /// Frames for which a visible node is drawn without another query, while the camera is slow.
    pub visible_for: u32,
    /// Frames for which an occluded node is culled without another query, while the camera is slow: aggressive above 0.
    pub occluded_for: u32,
    /// Most motion of the eye since an answer that counts as slow, as a part of the distance from the eye to the node.
    pub slow: f64,
    /// The order in which the entities of a batch are drawn.
    pub order: DrawOrder,
    /// Whether the traversal keeps a [`Sketch`](crate::Sketch) for debugging.
    pub sketch: bool,
}

impl Default for OccupancySettings {
    fn default() -> Self {
        Self {
            tree: HierarchyShape::Divided,
            block: 4,
            grain: 200,
            small: 0.0,
            least_seen: 0.1,
            together: 8,
            worth: 5000,
            visible_for: 5,
            occluded_for: 0,
            slow: 0.1,
            order: DrawOrder::State,
            sketch: false,
        }
    }
}

impl OccupancySettings {
    /// The settings of the traversal that these make.
    pub(super) fn traversal(&self, queries: QueryMode) -> TraversalSettings {
        TraversalSettings {
            queries,
            occupancy_map: true,
            block: self.block,
            grain: self.grain,
            small: self.small,
            least_seen: self.least_seen,
            batch: 1,
            sharing: Sharing::Neighbours(self.together),
            tight: TightBoxes::OFF,
            worth: self.worth,
            lifetime: AnswerLifetime {
                visible: self.visible_for,
                occluded: self.occluded_for,
                slow: self.slow,
            },
            retests: Retests::Spread,
            order: self.order,
            sketch: self.sketch,
            in_flight: 1,
            guard: GuardOptions::OFF,
        }
    }

    /// Whether no visible entity is culled.
    pub(super) fn conservative(&self) -> bool {
        self.small <= 0.0 && self.occluded_for == 0
    }
}

/// Settings without effect with a single query at a time.
pub(super) const BATCHES_ONLY: [&str; 3] = ["least-seen", "together", "worth"];

pub(super) const PARAMETERS: &[Parameter<OccupancySettings>] = &[
    Parameter::words(
        "tree",
        HierarchyShape::WORDS,
        "the scene's groups, a bounding volume hierarchy, or groups whose wide ones are divided",
        |s| s.tree.word(),
        |s, at| s.tree = HierarchyShape::ALL[at],
    ),
    Parameter::whole(
        "block",
        1..=256,
        "px",
        "pixels along a side of a block of the map",
        |s| s.block,
        |s, pixels| s.block = pixels,
    ),
    Parameter::whole(
        "grain",
        0..=u32::MAX,
        "triangles",
        "a node with at most this many triangles is not opened",
        |s| s.grain,
        |s, triangles| s.grain = triangles,
    ),
    Parameter::number(
        "small",
        0.0..=64.0,
        "px",
        "width and height in pixels below which a sub-tree is dropped (aggressive); 0: none is",
        |s| shortest(s.small),
        |s, pixels| s.small = pixels as f32,
    ),
    Parameter::number(
        "least-seen",
        0.0..=1.0,
        "",
        "part of a batch that must turn out visible for the next batch to be organised too; 0: always, as in the paper",
        |s| shortest(s.least_seen),
        |s, part| s.least_seen = part as f32,
    ),
    Parameter::whole(
        "together",
        1..=256,
        "nodes",
        "most neighbours in the tree, hidden one frame ago, that share a query; 1: each has its own",
        |s| s.together,
        |s, nodes| s.together = nodes,
    ),
    Parameter::whole(
        "worth",
        0..=u32::MAX,
        "triangles",
        "triangles that a wait must be able to save, beside 190 a query; below that, the waiting nodes are drawn",
        |s| s.worth,
        |s, triangles| s.worth = triangles,
    ),
    Parameter::whole(
        "visible-for",
        0..=1000,
        "frames",
        "frames for which a visible node is drawn without another query",
        |s| s.visible_for,
        |s, frames| s.visible_for = frames,
    ),
    Parameter::whole(
        "occluded-for",
        0..=1000,
        "frames",
        "frames for which an occluded node is left out without another query (aggressive)",
        |s| s.occluded_for,
        |s, frames| s.occluded_for = frames,
    ),
    Parameter::number(
        "slow",
        0.0..=10.0,
        "",
        "most camera motion since an answer for it to stay valid, as a part of the distance to the node",
        |s| s.slow,
        |s, part| s.slow = part,
    ),
    Parameter::words(
        "order",
        &["state", "depth"],
        "whether a batch is drawn by pipeline, texture and mesh, or near entities first",
        |s| match s.order {
            DrawOrder::State => "state",
            DrawOrder::Depth => "depth",
        },
        |s, at| {
            s.order = match at {
                1 => DrawOrder::Depth,
                _ => DrawOrder::State,
            };
        },
    ),
    Parameter::switch(
        "sketch",
        "whether a sketch of the traversal is kept for debugging",
        |s| s.sketch,
        |s, on| s.sketch = on,
    ),
];
