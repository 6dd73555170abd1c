//! The contract between a culling strategy and the stage that runs it.

use antumbra_graph::{Buffer, Host};
use thiserror::Error;

use crate::adaptive_threshold::AdaptiveThreshold;
use crate::candidates::Candidates;
use crate::frame_graph::FrameGraph;
use crate::latency::Latency;
use crate::narrowing::Narrowing;
use crate::tuning::{Setting, SettingError, Step, Tunable, Value};
use crate::verdict::Verdicts;
use crate::view_nodes::ViewNodes;

/// A culling strategy: a plug-in that adds nodes to the graph and says what the shaded pass draws.
///
/// A strategy [declares](Self::declare) its nodes once per view whenever a plan is compiled: at the start, for another scene, when the scene's layout changes (it outgrows its
/// buffers, or its pipeline classes, transparency, positional lights or environment change), when a view is resized, and when a budget goes to a step that has no plan yet. State between frames belongs in host values that
/// its nodes update. A host value is a resource in host memory; `docs/architecture.md` defines node, slot and reference.
///
/// ```no_run
/// use antumbra_cull::*;
///
/// /// Draws entities nearer than this many metres, and those that must not be tested.
/// struct Nearby(f64);
///
/// impl Strategy for Nearby {
///     fn name(&self) -> &str { "nearby" }
///     fn summary(&self) -> &str { "draws what is near" }
///     fn conservative(&self) -> bool { false }
///     fn declare(&mut self, g: &mut FrameGraph<'_>, view: &mut ViewNodes) -> Result<VisibleSet, DeclareError> {
///         let candidates = g.in_frustum(view);
///         let reach = self.0;
///         Ok(g.visible_by(view, candidates, move |table, frame, slot| {
///             let near = table.bounds(slot).distance(frame.camera.position) < reach;
///             // No verdict says "too far". This one says that a setting left the entity out, not that it is hidden.
///             if near || !table.is_tested(slot) { Verdict::Visible } else { Verdict::BelowThreshold }
///         }))
///     }
/// }
/// ```
pub trait Strategy: Send {
    /// Its name: lower case, words joined by hyphens.
    fn name(&self) -> &str;

    /// What it does, in a sentence.
    fn summary(&self) -> &str;

    /// Whether, with its present settings, it draws every entity that owns a pixel of the reference, and draws it at full detail. The reference is everything in the frustum at full detail; an
    /// entity owns the pixels at which it is in front.
    fn conservative(&self) -> bool;

    /// When the results of its visibility tests (queries or counts) are used; `None` for a strategy without such tests. [`Latency::SameFrame`] is refused in
    /// [`Mode::Embedded`](antumbra_graph::Mode::Embedded).
    fn latency(&self) -> Option<Latency> {
        None
    }

    /// What it is for in a comparison: a contender, or one of the yardsticks that others are measured by.
    fn role(&self) -> Role {
        Role::Contender
    }

    /// Whether the caller must supply the slots that own a pixel of the reference ([`ViewInput::reference`](crate::ViewInput::reference)). Only for measuring.
    fn needs_reference(&self) -> bool {
        false
    }

    /// Its settings and its steps between accuracy and speed; `None`: it has neither. Override this together with [`Self::tuning_mut`].
    fn tuning(&self) -> Option<&dyn Tunable> {
        None
    }

    /// Mutable access to [`Self::tuning`], to change settings.
    fn tuning_mut(&mut self) -> Option<&mut dyn Tunable> {
        None
    }

    /// Adds its nodes for one view to `g`, and returns what that view draws. Called for the views in order. Its shading passes draw into `view.targets` and leave the next versions
    /// there.
    ///
    /// # Errors
    /// [`DeclareError`] when its settings exclude each other, or the device lacks what they need. The caller gets it as [`StageError::Declare`](crate::StageError::Declare), from
    /// [`Stage::new`](crate::Stage::new) or from the frame that compiles a new plan.
    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError>;
}

/// What a strategy is for in a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Role {
    /// Draws everything: what culling has to beat.
    Everything,
    /// Draws what touches the frustum: what occlusion culling has to beat.
    Frustum,
    /// Draws exactly what is visible, known beforehand: the limit.
    Ideal,
    /// A strategy to be measured by these three.
    Contender,
}

impl Role {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::Everything,
        Self::Frustum,
        Self::Ideal,
        Self::Contender,
    ];

    /// Its word in reports.
    pub fn word(self) -> &'static str {
        match self {
            Self::Everything => "everything",
            Self::Frustum => "frustum",
            Self::Ideal => "ideal",
            Self::Contender => "contender",
        }
    }

    /// Whether others are measured by it. `antumbra compare` neither audits it nor gives it a budget.
    pub fn is_yardstick(self) -> bool {
        self != Self::Contender
    }
}

// Not methods of the trait: a strategy implements them in [`Tunable`], and none may override these.
impl dyn Strategy + '_ {
    /// Its settings as they stand; empty without any.
    pub fn settings(&self) -> Vec<Setting> {
        self.tuning().map(Tunable::settings).unwrap_or_default()
    }

    /// Its settings that follow the size of the image, with their values for views of so many pixels: see [`Tunable::following`].
    pub fn following(&self, size: [u32; 2]) -> Vec<(&'static str, Value)> {
        let tuning = self.tuning();
        tuning.map_or_else(Vec::new, |tuning| tuning.following(size))
    }

    /// Its steps from the most accurate to the fastest; empty without any.
    pub fn steps(&self) -> Vec<Step> {
        self.tuning().map(Tunable::steps).unwrap_or_default()
    }

    /// Sets the setting named `key`.
    ///
    /// # Errors
    /// As [`Tunable::set`]; [`SettingError::Unknown`] for a strategy without settings.
    pub fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        match self.tuning_mut() {
            Some(tuning) => tuning.set(key, value),
            None => Err(self.unknown_setting(key)),
        }
    }

    /// Sets the setting named `key` from text.
    ///
    /// # Errors
    /// As [`Tunable::set_text`]; [`SettingError::Unknown`] for a strategy without settings.
    pub fn set_text(&mut self, key: &str, text: &str) -> Result<(), SettingError> {
        match self.tuning_mut() {
            Some(tuning) => tuning.set_text(key, text),
            None => Err(self.unknown_setting(key)),
        }
    }

    fn unknown_setting(&self, key: &str) -> SettingError {
        SettingError::Unknown {
            strategy: self.name().to_owned(),
            key: key.to_owned(),
            known: Vec::new(),
        }
    }
}

/// Why a strategy cannot be declared as it is set, or on this device.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum DeclareError {
    /// It cannot run as it is set: settings exclude each other, a budget cannot be kept with them, or a reference is missing.
    #[error("strategy '{strategy}': {conflict}")]
    Settings {
        /// The strategy.
        strategy: String,
        /// What conflicts, why, and what to set instead.
        conflict: String,
    },
    /// The device lacks what the settings ask for.
    #[error("strategy '{strategy}': this device lacks {lacking}; {instead}")]
    Device {
        /// The strategy.
        strategy: String,
        /// The missing capability.
        lacking: String,
        /// What to set instead.
        instead: String,
    },
}

/// What a view draws, and why.
#[derive(Debug, Clone, Copy)]
pub struct VisibleSet {
    pub(crate) verdicts: SetVerdicts,
    /// In a chain: the candidates before and after the outer strategy removed some.
    pub(crate) narrowing: Option<Narrowing>,
}

/// How a view's verdicts are found.
#[derive(Debug, Clone, Copy)]
pub(crate) enum SetVerdicts {
    /// The strategy's nodes make them.
    FromNodes(VerdictSource),
    /// From what was drawn: a u32 a slot, not 0 for a drawn one. It is read back only where verdicts are asked for.
    DrawnBySlot(Buffer),
}

/// Where a view's verdicts can be read.
#[derive(Debug, Clone, Copy)]
pub(crate) enum VerdictSource {
    /// On the host.
    Host(Host<Verdicts>),
    /// On the GPU: they follow from the counts, the candidates and the rule.
    Gpu {
        candidates: Host<Candidates>,
        queried: Host<crate::Queried>,
        counts: Buffer,
        layout: crate::CountLayout,
        rule: crate::SampleRule,
        /// The threshold that the GPU finds for each frame; `None`: the rule's.
        adapted: Option<AdaptiveThreshold>,
    },
}

impl VerdictSource {
    /// From counts, with a fixed rule.
    pub fn by_counts(
        candidates: Host<Candidates>,
        counts: crate::Counts,
        rule: crate::SampleRule,
    ) -> Self {
        Self::Gpu {
            candidates,
            queried: counts.queried,
            counts: counts.buffer,
            layout: counts.layout,
            rule,
            adapted: None,
        }
    }
}

impl From<VerdictSource> for VisibleSet {
    fn from(verdicts: VerdictSource) -> Self {
        Self {
            verdicts: SetVerdicts::FromNodes(verdicts),
            narrowing: None,
        }
    }
}

impl VisibleSet {
    /// A set whose shaded passes the strategy has added itself (to [`ViewNodes::targets`]), with the verdicts that say what was drawn.
    pub fn drawn(verdicts: Host<Verdicts>) -> Self {
        VerdictSource::Host(verdicts).into()
    }

    /// A set that the GPU chose from all entities, in the frustum or not, whose passes the strategy has added itself. `drawn`: a u32 a slot, not 0 for what they drew. The host does nothing
    /// by entity for it, unless verdicts are [read](crate::Stage::verdicts) or the stage is audited.
    pub fn drawn_on_gpu(drawn: Buffer) -> Self {
        Self {
            verdicts: SetVerdicts::DrawnBySlot(drawn),
            narrowing: None,
        }
    }

    /// A set that the GPU chose, whose passes the strategy has added itself: a candidate is drawn if its count exceeds the rule's threshold, or if it was not
    /// tested or is exempt. The verdicts are derived from `candidates`, `counts` and `rule`, so these must describe what the passes drew. `counts` must be [`CountLayout::BySlot`](crate::CountLayout::BySlot).
    pub fn on_gpu(
        candidates: Host<Candidates>,
        counts: crate::Counts,
        rule: impl Into<crate::SampleRule>,
    ) -> Self {
        VerdictSource::by_counts(candidates, counts, rule.into()).into()
    }
}
