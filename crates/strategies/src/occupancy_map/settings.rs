//! The parameters of the strategies with an occupancy map: key, range, unit and description of each setting.

use antumbra_cull::{Latency, Parameter, shortest};
use antumbra_scene::hierarchy::HierarchyShape;

use super::{OccupancyMapBatched, OccupancySettings};
use crate::traversal::DrawOrder;

const LATENCIES: [Latency; 2] = [Latency::FrameLate, Latency::SameFrame];

/// The setting of `occupancy-map` that `occupancy-map-single` does not have.
pub(super) const LATENCY: &[Parameter<OccupancyMapBatched>] = &[Parameter::words(
    "latency",
    &["frame-late", "same-frame"],
    "when the answers are used",
    |s| s.latency.word(),
    |s, at| s.latency = LATENCIES[at],
)];

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
