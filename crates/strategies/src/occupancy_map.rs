//! Hierarchical culling with occupancy maps: what reaches a part of the screen that nothing was drawn to is visible without a query, and what has to be
//! asked about is asked about in batches that do not cover each other.
//!
//! Staneker, Bartz, Strasser, *Efficient Multiple Occlusion Queries for Scene Graph Systems*, 2004: `occupancy-map` is its multiple queries,
//! `occupancy-map-single` the authors' scheme before it, a query at a time.

mod settings;

use antumbra_scene::hierarchy::HierarchyShape;

use crate::traversal::{
    AnswerLifetime, DrawOrder, QueryMode, TraversalSettings, frame_late, same_frame,
};
use antumbra_cull::{
    DeclareError, FrameGraph, Latency, Setting, SettingError, Step, Strategy, Tunable, Value,
    ViewNodes, VisibleSet, assign, describe,
};

/// What both strategies can be told.
#[derive(Debug, Clone, PartialEq)]
pub struct OccupancySettings {
    /// Where the tree's inner nodes come from.
    pub tree: HierarchyShape,
    /// Pixels along a side of a block of the map: 1 to 256.
    pub block: u32,
    /// Triangles below a node that is not opened: opening it would cost more queries than it can save.
    pub grain: u32,
    /// Pixels in width and height below which a sub-tree is dropped, aggressive; 0: none is.
    pub small: f32,
    /// The part of a batch that must come out visible for the next one to be organised as well; below it, nothing new stands before those who wait. 0:
    /// batches are organised whatever came of the last one, as in the paper.
    pub least_seen: f32,
    /// Up to how many neighbours in the tree that were hidden a frame ago one query asks about: where it finds a sample, each is asked about for itself. 1: each alone, as
    /// in the paper.
    pub together: u32,
    /// Triangles that a wait must be able to save, beside 190 a query: where all who wait have no more between them, they are drawn without a question. 0:
    /// whoever waits is asked about, as in the paper.
    pub worth: u32,
    /// Frames for which what was found visible is drawn without another query, while the camera is slow.
    pub visible_for: u32,
    /// Frames for which what was found occluded is left out without another query, while the camera is slow: aggressive.
    pub occluded_for: u32,
    /// What counts as slow: the way the eye has come since the answer, as a part of its distance to the node.
    pub slow: f64,
    /// Whether the entities of a batch are drawn near ones first, not by pipeline, texture and mesh.
    pub by_depth: bool,
    /// Whether a sketch of the walk is left for whoever debugs it.
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
            by_depth: false,
            sketch: false,
        }
    }
}

impl OccupancySettings {
    fn how(&self, asking: QueryMode) -> TraversalSettings {
        TraversalSettings {
            asking,
            map: true,
            block: self.block,
            grain: self.grain,
            small: self.small,
            least_seen: self.least_seen,
            together: self.together,
            worth: self.worth,
            remember: AnswerLifetime {
                visible: self.visible_for,
                occluded: self.occluded_for,
                slow: self.slow,
            },
            order: match self.by_depth {
                true => DrawOrder::Depth,
                false => DrawOrder::State,
            },
            sketch: self.sketch,
        }
    }

    fn conservative(&self) -> bool {
        self.small <= 0.0 && self.occluded_for == 0
    }
}

/// What the steps of a trade drop, in pixels of width and height.
const SMALL: [f64; 7] = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0];

/// The strategy `occupancy-map`: multiple queries.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OccupancyMapBatched {
    /// Its settings.
    pub settings: OccupancySettings,
    /// When the answers are used: [`Latency::SameFrame`] or [`Latency::FrameLate`].
    pub latency: Latency,
}

/// The strategy `occupancy-map-single`: a query at a time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OccupancyMapSingle {
    /// Its settings.
    pub settings: OccupancySettings,
}

impl Strategy for OccupancyMapBatched {
    fn name(&self) -> &str {
        "occupancy-map"
    }

    fn summary(&self) -> &str {
        "walks the tree front to back; what reaches free screen is drawn, the rest asked about in batches (Staneker et al. 2004)"
    }

    fn conservative(&self) -> bool {
        self.latency == Latency::SameFrame && self.settings.conservative()
    }

    fn latency(&self) -> Option<Latency> {
        Some(self.latency)
    }

    fn tuning(&self) -> Option<&dyn Tunable> {
        Some(self)
    }

    fn tuning_mut(&mut self) -> Option<&mut dyn Tunable> {
        Some(self)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let how = self.settings.how(QueryMode::Batches);
        let shape = self.settings.tree;
        Ok(match self.latency {
            Latency::FrameLate => frame_late(g, view, shape, how),
            _ => same_frame(g, view, shape, how),
        })
    }
}

impl Strategy for OccupancyMapSingle {
    fn name(&self) -> &str {
        "occupancy-map-single"
    }

    fn summary(&self) -> &str {
        "as occupancy-map, a query at a time, each waited for (Staneker et al. 2003)"
    }

    fn conservative(&self) -> bool {
        self.settings.conservative()
    }

    fn latency(&self) -> Option<Latency> {
        Some(Latency::SameFrame)
    }

    fn tuning(&self) -> Option<&dyn Tunable> {
        Some(self)
    }

    fn tuning_mut(&mut self) -> Option<&mut dyn Tunable> {
        Some(self)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let how = TraversalSettings {
            worth: 0,
            ..self.settings.how(QueryMode::Single)
        };
        Ok(same_frame(g, view, self.settings.tree, how))
    }
}

impl Tunable for OccupancyMapBatched {
    fn settings(&self) -> Vec<Setting> {
        let own = describe(settings::LATENCY, self).into_iter();
        own.chain(describe(settings::PARAMETERS, &self.settings))
            .collect()
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        let own = settings::LATENCY
            .iter()
            .any(|parameter| parameter.key() == key);
        let known = settings::PARAMETERS
            .iter()
            .any(|parameter| parameter.key() == key);
        match (own, known) {
            (true, _) => assign("occupancy-map", settings::LATENCY, self, key, value),
            (_, true) => assign(
                "occupancy-map",
                settings::PARAMETERS,
                &mut self.settings,
                key,
                value,
            ),
            _ => Err(unknown(self, key)),
        }
    }

    fn steps(&self) -> Vec<Step> {
        let step = |latency: Latency, small: f64| {
            Step::of([("latency", latency.word().into()), ("small", small.into())])
        };
        let exact = step(Latency::SameFrame, 0.0).and([("occluded-for", 0u32.into())]);
        let fast = SMALL.map(|small| step(self.latency, small));
        std::iter::once(exact).chain(fast).collect()
    }
}

impl Tunable for OccupancyMapSingle {
    fn settings(&self) -> Vec<Setting> {
        let mut settings = describe(settings::PARAMETERS, &self.settings);
        settings.retain(|setting| !settings::OF_BATCHES.contains(&setting.key));
        settings
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        if settings::OF_BATCHES.contains(&key) {
            return Err(unknown(self, key));
        }
        assign(
            "occupancy-map-single",
            settings::PARAMETERS,
            &mut self.settings,
            key,
            value,
        )
        .map_err(|error| match error {
            SettingError::Unknown { .. } => unknown(self, key),
            error => error,
        })
    }

    fn steps(&self) -> Vec<Step> {
        let exact = Step::of([("small", 0u32.into()), ("occluded-for", 0u32.into())]);
        let fast = SMALL.map(|small| Step::of([("small", small.into())]));
        std::iter::once(exact).chain(fast).collect()
    }
}

/// The error for a setting that a strategy does not have.
fn unknown(strategy: &(impl Strategy + Tunable), key: &str) -> SettingError {
    let known = strategy.settings();
    SettingError::Unknown {
        strategy: strategy.name().to_owned(),
        key: key.to_owned(),
        known: known.iter().map(|setting| setting.key).collect(),
    }
}
