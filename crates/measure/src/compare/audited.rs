//! What audits said, held against the truth, and what budgets were kept with.

use antumbra_cull::{Audit, Budget, Stage};

use crate::report::{AuditReport, BudgetReport};

/// The audits and standings of one stage, pose by pose.
#[derive(Default)]
pub struct Audited {
    /// Frames whose audits were looked at, a view.
    taken: Vec<u64>,
    /// Of frames whose truth is known: how many there were, and in how many the interval held it.
    frames: u64,
    held: u64,
    patches: u64,
    /// The audit's estimates by frame, all views added up, and how many views said anything.
    estimates: Vec<(f64, u32)>,
    /// How many frames each step was stood on.
    stood: Vec<u64>,
    allowed: f64,
}

impl Audited {
    /// Takes in what is new after a frame; `truth` knows the wrong pixels, in percent, of a view in an earlier frame.
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
                    self.estimates.resize(frame + 1, (0.0, 0));
                }
                if let Some((sum, number)) = self.estimates.get_mut(frame) {
                    *sum += estimate.percent;
                    *number += 1;
                }
            }
        }
        if let Some((standing, _)) = stage.budget_state() {
            if self.stood.len() <= standing.step {
                self.stood.resize(standing.step + 1, 0);
            }
            if let Some(frames) = self.stood.get_mut(standing.step) {
                *frames += 1;
            }
            self.allowed += standing.allow;
        }
    }

    /// The audit's part of the report; `None` where there was none. The mean and its interval are those of the first view's frames that are
    /// remembered, or, with two eyes, of both.
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
                .map(|(sum, number)| sum / f64::from((*number).max(1)))
                .collect(),
        })
    }

    /// The budget's part of the report; `None` where there was none.
    pub fn budget_report(&self, budget: Option<Budget>, mean_percent: f64) -> Option<BudgetReport> {
        let budget = budget?;
        let frames = self.stood.iter().sum::<u64>().max(1) as f64;
        Some(BudgetReport {
            asked: budget.to_string(),
            kept: match budget {
                Budget::WrongPixels(percent) => Some(mean_percent <= percent),
                Budget::FrameTime(_) => None,
            },
            frames_a_step: self.stood.clone(),
            allowed_percent: self.allowed / frames,
        })
    }
}
