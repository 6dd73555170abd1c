//! The contract between a culling strategy and the stage that runs it.

use antumbra_graph::{Buffer, Host};
use thiserror::Error;

use crate::candidates::Candidates;
use crate::frame_graph::FrameGraph;
use crate::hand_on::HandedOn;
use crate::setting::{Setting, SettingError};
use crate::turned::Turned;
use crate::verdict::Verdicts;
use crate::view_nodes::ViewNodes;

/// A culling strategy: a plug-in that adds nodes to the graph and says what the shaded pass shall draw.
///
/// A strategy is asked to [`declare`](Self::declare) its nodes once a view whenever the plan is compiled: at the start, and when
/// the scene outgrows its buffers. Whatever it keeps between frames belongs into host values that its nodes update.
///
/// ```no_run
/// use antumbra_cull::*;
///
/// /// Draws whatever has a corner within a distance.
/// struct Nearby(f64);
///
/// impl Strategy for Nearby {
///     fn name(&self) -> &str { "nearby" }
///     fn summary(&self) -> &str { "draws what is near" }
///     fn conservative(&self) -> bool { false }
///     fn declare(&mut self, g: &mut FrameGraph<'_>, view: &mut ViewNodes) -> Result<VisibleSet, DeclareError> {
///         let candidates = g.in_frustum(view);
///         let reach = self.0;
///         Ok(g.visible_by(view, candidates, move |table, view, slot| {
///             if table.bounds(slot).distance(view.camera.position) < reach { Verdict::Visible } else { Verdict::BelowThreshold }
///         }))
///     }
/// }
/// ```
pub trait Strategy: Send {
    /// Its name: lower case, words joined by hyphens.
    fn name(&self) -> &str;

    /// What it does, in a sentence.
    fn summary(&self) -> &str;

    /// Whether, set as it is, it never culls an entity that owns a pixel of the reference.
    fn conservative(&self) -> bool;

    /// When the answers of its queries are used, where it asks any.
    fn latency(&self) -> Option<crate::Latency> {
        None
    }

    /// Whether it must be told which entities own a pixel ([`ViewInput::reference`](crate::ViewInput::reference)): a limit to measure by, nothing to ship.
    fn needs_reference(&self) -> bool {
        false
    }

    /// Its knobs as they stand.
    fn settings(&self) -> Vec<Setting> {
        Vec::new()
    }

    /// Turns a knob.
    ///
    /// # Errors
    /// [`SettingError`] for a knob it does not have or a value out of range.
    fn set(&mut self, key: &str, value: &str) -> Result<(), SettingError> {
        let _ = value;
        Err(SettingError::Unknown {
            strategy: self.name().to_owned(),
            key: key.to_owned(),
            known: self.settings().iter().map(|setting| setting.key).collect(),
        })
    }

    /// How it trades accuracy for speed when it is given a [`Budget`](crate::Budget): its steps from the most accurate, which is conservative, to the
    /// fastest. None: it has nothing to trade.
    fn steps(&self) -> Vec<crate::Step> {
        Vec::new()
    }

    /// Adds its nodes for one view and says what that view draws.
    ///
    /// # Errors
    /// [`DeclareError`] when its settings do not go together, or the device cannot do what they ask for.
    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError>;
}

/// Why a strategy cannot be declared as it is set, or on this device.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum DeclareError {
    /// Two settings exclude each other.
    #[error("strategy '{strategy}': {conflict}")]
    Settings {
        /// The strategy.
        strategy: String,
        /// Which, why, and what to set instead.
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
    pub(crate) verdicts: VerdictSource,
    /// What was left to whoever found it, where another strategy came before.
    pub(crate) handed_on: Option<HandedOn>,
}

/// Where a view's verdicts can be read.
#[derive(Debug, Clone, Copy)]
pub(crate) enum VerdictSource {
    /// On the host.
    Host(Host<Verdicts>),
    /// On the GPU: they follow from the counts, the candidates and the rule.
    Gpu {
        candidates: Host<Candidates>,
        asked: Host<crate::Asked>,
        counts: Buffer,
        layout: crate::CountLayout,
        rule: crate::SampleRule,
        /// The frame's threshold, where it is not the rule's.
        turned: Option<Turned>,
    },
}

impl From<VerdictSource> for VisibleSet {
    fn from(verdicts: VerdictSource) -> Self {
        Self {
            verdicts,
            handed_on: None,
        }
    }
}

impl VisibleSet {
    /// A set whose shaded passes the strategy has added itself (to [`ViewNodes::targets`]), with the verdicts that say what was drawn.
    pub fn drawn(verdicts: Host<Verdicts>) -> Self {
        VerdictSource::Host(verdicts).into()
    }

    /// A set that the GPU chose, whose passes the strategy has added itself: a candidate is drawn if its count of visible samples passes the rule, or if no
    /// test may judge it. `counts` are by slot.
    pub fn on_gpu(
        candidates: Host<Candidates>,
        counts: crate::Counts,
        rule: impl Into<crate::SampleRule>,
    ) -> Self {
        VerdictSource::Gpu {
            candidates,
            asked: counts.asked,
            counts: counts.buffer,
            layout: counts.layout,
            rule: rule.into(),
            turned: None,
        }
        .into()
    }
}
