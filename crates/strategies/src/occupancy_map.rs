//! Hierarchical culling with an occupancy map. A node of the tree that reaches a part of the screen where nothing was drawn is visible without a
//! query. All other nodes are queried in batches of nodes that do not cover each other.
//!
//! Staneker, Bartz, Strasser, *Efficient Multiple Occlusion Queries for Scene Graph Systems*, 2004. `occupancy-map` is the paper's multiple
//! queries; `occupancy-map-single` is the authors' earlier scheme (Staneker, Bartz, Meissner 2003), which waits for each query.

mod settings;

use crate::traversal::{QueryMode, Traversal, TraversalSettings, frame_late, same_frame};
use antumbra_cull::guard::GuardOptions;
use antumbra_cull::{
    DeclareError, FrameGraph, Latency, Parameter, Setting, SettingError, Step, Strategy, Tunable,
    Value, ViewNodes, VisibleSet, assign, describe,
};

pub use settings::OccupancySettings;

const LATENCIES: [Latency; 2] = [Latency::FrameLate, Latency::SameFrame];

/// The setting of `occupancy-map` that `occupancy-map-single` does not have.
const LATENCY: &[Parameter<OccupancyMapBatched>] = &[
    Parameter::words(
        "latency",
        &["frame-late", "same-frame"],
        "when the answers are used",
        |s| s.latency.word(),
        |s, at| s.latency = LATENCIES[at],
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

/// The setting `small` of the steps from exact to fast, in pixels.
const SMALL: [f64; 7] = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0];

/// The strategy `occupancy-map`: queries in batches.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OccupancyMapBatched {
    /// The settings of the traversal.
    pub settings: OccupancySettings,
    /// When the answers are used: [`Latency::SameFrame`] or [`Latency::FrameLate`].
    pub latency: Latency,
    /// How far the eye goes a frame, for late answers that hide nothing that has come into view meanwhile.
    pub guard: GuardOptions,
}

/// The strategy `occupancy-map-single`: a query at a time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OccupancyMapSingle {
    /// The settings of the traversal.
    pub settings: OccupancySettings,
}

impl Strategy for OccupancyMapBatched {
    fn name(&self) -> &str {
        "occupancy-map"
    }

    fn summary(&self) -> &str {
        "traverses the tree front to back; draws what reaches free screen, queries the rest in batches (Staneker et al. 2004)"
    }

    fn conservative(&self) -> bool {
        match self.latency {
            // What is occluded is confirmed, however old its answer is.
            Latency::FrameLate => self.guard.is_on() && self.settings.small <= 0.0,
            _ => self.settings.conservative(),
        }
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
        let settings = TraversalSettings {
            guard: self.guard,
            ..self.settings.traversal(QueryMode::Batches)
        };
        let shape = self.settings.tree;
        Ok(match self.latency {
            Latency::FrameLate => frame_late(g, view, shape, settings),
            _ => same_frame::<Traversal>(g, view, shape, settings),
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
        let settings = TraversalSettings {
            worth: 0,
            ..self.settings.traversal(QueryMode::Single)
        };
        Ok(same_frame::<Traversal>(
            g,
            view,
            self.settings.tree,
            settings,
        ))
    }
}

impl Tunable for OccupancyMapBatched {
    fn settings(&self) -> Vec<Setting> {
        let own = describe(LATENCY, self).into_iter();
        own.chain(describe(settings::PARAMETERS, &self.settings))
            .collect()
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        let own = LATENCY.iter().any(|parameter| parameter.key() == key);
        let known = settings::PARAMETERS
            .iter()
            .any(|parameter| parameter.key() == key);
        match (own, known) {
            (true, _) => assign("occupancy-map", LATENCY, self, key, value),
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
        settings.retain(|setting| !settings::BATCHES_ONLY.contains(&setting.key));
        settings
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        if settings::BATCHES_ONLY.contains(&key) {
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

/// The error for a key that is no setting of the strategy.
fn unknown(strategy: &(impl Strategy + Tunable), key: &str) -> SettingError {
    let known = strategy.settings();
    SettingError::Unknown {
        strategy: strategy.name().to_owned(),
        key: key.to_owned(),
        known: known.iter().map(|setting| setting.key).collect(),
    }
}
