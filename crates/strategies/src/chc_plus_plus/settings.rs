//! The settings of `chc-plus-plus`: parameters (key, range, unit, description) and what they mean to a traversal.

use antumbra_cull::guard::GuardOptions;
use antumbra_cull::{Latency, Parameter, shortest};
use antumbra_scene::hierarchy::HierarchyShape;

use super::ChcPlusPlus;
use crate::traversal::{
    AnswerLifetime, DrawOrder, QueryMode, Retests, Sharing, TightBoxes, TraversalSettings,
};

pub(super) const LATENCIES: [Latency; 2] = [Latency::FrameLate, Latency::SameFrame];

impl ChcPlusPlus {
    /// The settings of the traversal that these make.
    pub(super) fn traversal(&self) -> TraversalSettings {
        TraversalSettings {
            queries: QueryMode::Batches,
            occupancy_map: self.free_screen,
            block: 4,
            grain: self.grain,
            small: 0.0,
            least_seen: 0.0,
            batch: self.batch,
            sharing: match self.multiqueries {
                true => Sharing::Multiqueries,
                false => Sharing::Neighbours(1),
            },
            tight: TightBoxes {
                depth: self.tight_depth,
                surface: self.tight_surface,
            },
            worth: self.worth,
            lifetime: AnswerLifetime {
                visible: self.visible_for,
                occluded: 0,
                // The answer "visible" holds for any motion: it draws more, and never less.
                slow: f64::MAX,
            },
            retests: match self.randomised {
                true => Retests::Randomised { seed: self.seed },
                false => Retests::Regular,
            },
            order: DrawOrder::State,
            sketch: self.sketch,
            in_flight: 1,
            guard: self.guard,
        }
    }
}

pub(super) const PARAMETERS: &[Parameter<ChcPlusPlus>] = &[
    Parameter::words(
        "latency",
        &["frame-late", "same-frame"],
        "when the answers are used",
        |s| s.latency.word(),
        |s, at| s.latency = LATENCIES[at],
    ),
    Parameter::words(
        "tree",
        HierarchyShape::WORDS,
        "the scene's groups, a bounding volume hierarchy, or groups whose wide ones are divided",
        |s| s.tree.word(),
        |s, at| s.tree = HierarchyShape::ALL[at],
    ),
    Parameter::whole(
        "batch",
        1..=1_000_000,
        "nodes",
        "least nodes that gather before they are queried, where so many wait",
        |s| s.batch,
        |s, nodes| s.batch = nodes,
    ),
    Parameter::switch(
        "multiqueries",
        "whether nodes that will probably stay hidden share a query",
        |s| s.multiqueries,
        |s, on| s.multiqueries = on,
    ),
    Parameter::whole(
        "tight-depth",
        0..=8,
        "levels",
        "most levels below a node whose boxes are drawn in place of its own; 0: its own box is drawn",
        |s| s.tight_depth,
        |s, levels| s.tight_depth = levels,
    ),
    Parameter::number(
        "tight-surface",
        0.0..=16.0,
        "",
        "most surface of the boxes below a node, as a multiple of that of its own box",
        |s| shortest(s.tight_surface),
        |s, times| s.tight_surface = times as f32,
    ),
    Parameter::whole(
        "visible-for",
        0..=1000,
        "frames",
        "frames for which a visible leaf is drawn without another query",
        |s| s.visible_for,
        |s, frames| s.visible_for = frames,
    ),
    Parameter::switch(
        "randomised",
        "whether the first of these periods ends after a random number of frames",
        |s| s.randomised,
        |s, on| s.randomised = on,
    ),
    Parameter::whole(
        "seed",
        0..=u32::MAX,
        "",
        "the seed of these numbers",
        |s| s.seed,
        |s, seed| s.seed = seed,
    ),
    Parameter::switch(
        "free-screen",
        "whether a node without an answer that reaches a part of the screen where nothing was drawn is visible without a query",
        |s| s.free_screen,
        |s, on| s.free_screen = on,
    ),
    Parameter::whole(
        "grain",
        0..=u32::MAX,
        "triangles",
        "a node with at most this many triangles is not opened",
        |s| s.grain,
        |s, triangles| s.grain = triangles,
    ),
    Parameter::whole(
        "worth",
        0..=u32::MAX,
        "triangles",
        "triangles that a wait must be able to save, beside 190 a query; below that, the nodes are drawn",
        |s| s.worth,
        |s, triangles| s.worth = triangles,
    ),
    Parameter::switch(
        "sketch",
        "whether a sketch of the traversal is kept for debugging",
        |s| s.sketch,
        |s, on| s.sketch = on,
    ),
    Parameter::number(
        "guard",
        GuardOptions::METRES,
        "m",
        GuardOptions::METRES_MEAN,
        |s| s.guard.metres,
        |s, metres| s.guard.metres = metres,
    ),
    Parameter::number(
        "guard-turn",
        GuardOptions::DEGREES,
        "degrees",
        GuardOptions::DEGREES_MEAN,
        |s| s.guard.degrees,
        |s, degrees| s.guard.degrees = degrees,
    ),
];
