//! Falling back to `frustum`: where the strategy relies on what the driver gets wrong, and where an audit finds what a conservative strategy cannot have done.

use std::collections::BTreeSet;
use std::sync::Arc;

use antumbra_graph::Mode;

use super::distrust::{Distrust, DistrustCause, Instead};
use super::{Stage, StageError};
use crate::audit::FrameAudit;
use crate::self_test::{Capability, Outcome, SelfTestReport};
use crate::trust::Trust;
use crate::yardsticks::FrustumOnly;

impl Stage {
    /// Where the driver was found wrong, and what this stage does otherwise since; empty while it is believed. Read it once a frame, or whenever a frame was
    /// [rebuilt](crate::StageReport::rebuilt).
    pub fn distrust(&self) -> &[Distrust] {
        &self.distrust
    }

    /// What the device's self-test found of what the strategy relies on, and of what else was tried so far; `None` where it was [turned off](crate::DistrustOptions::self_test), and for a
    /// yardstick.
    pub fn self_test(&self) -> Option<&SelfTestReport> {
        self.tested.as_deref()
    }

    /// What the strategy is declared with.
    pub(super) fn trust(&self) -> Trust {
        Trust::by(self.tested.as_ref().map(Arc::clone))
    }

    /// Tries what a declared strategy relies on, notes what it does otherwise, and replaces it if it relies on what is known to be wrong. Whether it must be declared again.
    pub(super) fn heeds(&mut self, trust: &Trust) -> Result<bool, StageError> {
        if !self.options.distrust.self_test || self.strategy.role().is_yardstick() {
            return Ok(false);
        }
        let betrayed = trust.betrayed();
        if !betrayed.is_empty() {
            for capability in &betrayed {
                self.note(*capability, Instead::Frustum);
            }
            self.fall_back();
            return Ok(true);
        }
        let report = self.tried(trust.relied.clone())?;
        let is_wrong = |relied: &Capability| report.has_failed(*relied);
        if trust.relied.iter().any(is_wrong) {
            // What may be counted by instead.
            self.tried([Capability::FragmentAtomics, Capability::FragmentCompare].into())?;
            return Ok(true);
        }
        for replaced in &trust.replaced {
            let wrong = Capability::of(replaced.wrong);
            self.note(wrong, Instead::Counting(replaced.instead));
        }
        Ok(false)
    }

    /// Tries capabilities of the driver. A stage in a host's frame that has begun to draw cannot wait, and has what is known.
    fn tried(
        &mut self,
        mut which: BTreeSet<Capability>,
    ) -> Result<Arc<SelfTestReport>, StageError> {
        let samples = self.options.samples;
        if self.options.mode == Mode::Embedded && self.frames > 0 {
            which.clear();
        } else if self.controller.is_some() {
            // Other steps rely on other things.
            which.extend(Capability::ALL);
        }
        let report = self.gpu.tried(samples, &which)?;
        self.tested = Some(Arc::clone(&report));
        Ok(report)
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
