//! Compares the estimates of audits with the measured errors, and records how budgets were kept.

use antumbra_cull::{Audit, Budget, Stage};

use crate::report::{AuditReport, BudgetReport, ErrorReport, MeanMax};

/// The audits and budget steps of one stage.
#[derive(Default)]
pub struct Audited {
    /// By view: frames whose audits were taken in.
    taken: Vec<u64>,
    /// Frames with an audit and a measured error.
    frames: u64,
    /// Of those, frames whose interval contains the measured error.
    held: u64,
    patches: u64,
    /// By frame.
    estimates: Vec<FrameEstimate>,
    /// By step of the budget: frames on that step.
    frames_a_step: Vec<u64>,
    allowed: f64,
}

/// The audit's estimates of one frame.
#[derive(Debug, Clone, Copy, Default)]
struct FrameEstimate {
    /// Sum over the views, in percent.
    percent: f64,
    /// Views with an estimate.
    views: u32,
}

impl Audited {
    /// Takes in the new audits after a frame. `truth` returns the measured wrong pixels, in percent, of a view in an earlier frame.
    pub fn take(
        &mut self,
        stage: &Stage,
        views: usize,
        truth: impl Fn(usize, usize) -> Option<f64>,
    ) {
        self.taken.resize(views, 0);
        for (view, taken) in self.taken.iter_mut().enumerate() {
            let Some(audit) = stage.audit(view) else {
                continue;
            };
            let fresh = audit.audited().saturating_sub(*taken) as usize;
            *taken = audit.audited();
            for found in audit.frames().rev().take(fresh) {
                let frame = found.frame as usize;
                let Some(truth) = truth(view, frame) else {
                    continue;
                };
                let estimate = found.wrong_pixels_percent();
                self.frames += 1;
                self.held += u64::from(estimate.holds(truth));
                self.patches += u64::from(found.patches);
                if self.estimates.len() <= frame {
                    self.estimates.resize(frame + 1, FrameEstimate::default());
                }
                if let Some(of_frame) = self.estimates.get_mut(frame) {
                    of_frame.percent += estimate.percent;
                    of_frame.views += 1;
                }
            }
        }
        if let Some((standing, _)) = stage.budget_state() {
            if self.frames_a_step.len() <= standing.step {
                self.frames_a_step.resize(standing.step + 1, 0);
            }
            if let Some(frames) = self.frames_a_step.get_mut(standing.step) {
                *frames += 1;
            }
            self.allowed += standing.allow;
        }
    }

    /// The audit's part of the report; `None` where there was no audit. The mean and its interval are over the frames that the audits keep,
    /// of all views.
    pub fn report(&self, stage: &Stage, views: usize) -> Option<AuditReport> {
        let audits: Vec<&Audit> = (0..views).filter_map(|view| stage.audit(view)).collect();
        if self.frames == 0 || audits.is_empty() {
            return None;
        }
        let all = Audit::over_all(&audits);
        Some(AuditReport {
            frames: self.frames,
            patches: self.patches as f64 / self.frames as f64,
            percent: all.percent,
            low: all.low,
            high: all.high,
            frames_within: self.held,
            wrong_pixels_percent: self
                .estimates
                .iter()
                .map(|frame| frame.percent / f64::from(frame.views.max(1)))
                .collect(),
        })
    }

    /// The budget's part of the report; `None` where there was no budget.
    pub fn budget_report(
        &self,
        budget: Option<Budget>,
        error: &ErrorReport,
    ) -> Option<BudgetReport> {
        let budget = budget?;
        let frames = self.frames_a_step.iter().sum::<u64>().max(1) as f64;
        let keeps = |wrong: MeanMax| match budget {
            Budget::WrongPixels(percent) => Some(wrong.mean <= percent),
            Budget::FrameTime(_) => None,
        };
        Some(BudgetReport {
            asked: budget.to_string(),
            kept: keeps(error.wrong_pixels_percent),
            kept_of_owned: error.wrong_of_owned_percent.and_then(keeps),
            frames_a_step: self.frames_a_step.clone(),
            allowed_percent: self.allowed / frames,
        })
    }
}
