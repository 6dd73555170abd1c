//! Falling back to `frustum`: where the strategy relies on what the driver gets wrong, and where an audit finds what a conservative strategy cannot have done.

use std::sync::Arc;

use super::distrust::{Distrust, DistrustCause, Instead};
use super::{Stage, StageError, StageOptions};
use crate::audit::FrameAudit;
use crate::device::Gpu;
use crate::self_test::{Capability, Outcome, SelfTestReport, Tested};
use crate::strategy::Strategy;
use crate::trust::Trust;
use crate::yardsticks::FrustumOnly;

/// What the device's self-test found; `None` where a stage needs none.
pub(super) fn tested(
    gpu: &Gpu,
    strategy: &dyn Strategy,
    options: &StageOptions,
) -> Result<Option<Tested>, StageError> {
    let needed = options.distrust.self_test && !strategy.role().is_yardstick();
    Ok(needed.then(|| gpu.tested(options.samples)).transpose()?)
}

impl Stage {
    /// Where the driver was found wrong, and what this stage does otherwise since; empty while it is believed. Read it once a frame, or whenever a frame was
    /// [rebuilt](crate::StageReport::rebuilt).
    pub fn distrust(&self) -> &[Distrust] {
        &self.distrust
    }

    /// What the device's self-test found; `None` where it was [turned off](crate::DistrustOptions::self_test), and for a yardstick.
    pub fn self_test(&self) -> Option<&SelfTestReport> {
        self.tested.as_deref()
    }

    /// What the strategy is declared with.
    pub(super) fn trust(&self) -> Trust {
        Trust::by(self.tested.as_ref().map(Arc::clone))
    }

    /// Notes what a declared strategy does otherwise, and replaces the strategy if it relies on what is wrong. Whether it did.
    pub(super) fn heeds(&mut self, trust: &Trust) -> bool {
        for replaced in &trust.replaced {
            self.note(
                Capability::of(replaced.wrong),
                Instead::Counting(replaced.instead),
            );
        }
        let betrayed = trust.betrayed();
        for capability in &betrayed {
            self.note(*capability, Instead::Frustum);
        }
        if betrayed.is_empty() {
            return false;
        }
        self.fall_back();
        true
    }

    /// Notes, once, that something is done instead of relying on a capability.
    fn note(&mut self, capability: Capability, instead: Instead) {
        let outcome = self
            .tested
            .as_ref()
            .and_then(|report| report.outcome(capability));
        let Some(Outcome::Failed(failure)) = outcome else {
            return;
        };
        let cause = DistrustCause::SelfTest {
            capability,
            failure: failure.clone(),
        };
        let known = |known: &Distrust| known.cause == cause && known.instead == instead;
        if !self.distrust.iter().any(known) {
            self.push(cause, instead);
        }
    }

    fn push(&mut self, cause: DistrustCause, instead: Instead) {
        let distrust = Distrust {
            strategy: self.strategy.name().to_owned(),
            from_frame: self.frames,
            cause,
            instead,
        };
        tracing::warn!(adapter = self.gpu.title(), "{distrust}");
        self.distrust.push(distrust);
    }

    /// Replaces the strategy. The next plan draws what is in the frustum.
    fn fall_back(&mut self) {
        self.strategy = Box::new(FrustumOnly);
        self.controller = None;
        self.conservative_from = None;
        self.replacements += 1;
    }

    /// Notes whether the frame that is about to be run must be without a wrong pixel.
    pub(super) fn note_promise(&mut self) {
        let promises = self.strategy.conservative() && !self.strategy.role().is_yardstick();
        self.conservative_from = promises.then(|| self.conservative_from.unwrap_or(self.frames));
    }

    /// Falls back, as an audit has found wrong pixels in a frame that promised to have none.
    pub(super) fn trip(&mut self, view: usize, found: &FrameAudit) {
        if !self.options.distrust.trip_wire {
            return;
        }
        let view = self.specs.get(view).map(|spec| spec.name.clone());
        let cause = DistrustCause::Audit {
            view: view.unwrap_or_default(),
            frame: found.frame,
            wrong_pixels_percent: found.wrong_pixels_percent(),
        };
        self.push(cause, Instead::Frustum);
        self.fall_back();
    }
}
