//! Which of two settings is faster, and how certain that is.

use crate::report::{Report, RunnerUp, StrategyReport};
use crate::stats::{block_ratios, median, sign_test};
use crate::trade_off::TimeBase;

/// Tells speeds of one report apart.
pub(super) struct SpeedComparison {
    clock: TimeBase,
    noise: f64,
    block: usize,
}

impl SpeedComparison {
    pub(super) fn of(report: &Report) -> Self {
        let frames = usize::try_from(report.scene.frames).unwrap_or(usize::MAX);
        let block = report.noise.block_frames.map(usize::try_from);
        Self {
            clock: TimeBase::of(report),
            noise: report.noise.least_ratio(),
            block: block
                .and_then(Result::ok)
                .unwrap_or_else(|| crate::compare::usual_block(frames)),
        }
    }

    /// Whether `a` is faster than `b` by more than the noise: by their times against the yardstick
    /// that all share, and block by block against each other. Where the two disagree nothing was
    /// shown.
    pub(super) fn faster(&self, a: &StrategyReport, b: &StrategyReport) -> bool {
        let beyond = |ratio: Option<f64>| ratio.is_some_and(|ratio| ratio > self.noise);
        beyond(self.by_yardstick(b, a))
            && self
                .blocks(b, a)
                .is_none_or(|ratios| beyond(median(&ratios).ok()))
    }

    /// How `other` did against the `fastest`.
    pub(super) fn runner_up(
        &self,
        other: &StrategyReport,
        fastest: &StrategyReport,
    ) -> Option<RunnerUp> {
        let ratios = self.blocks(other, fastest);
        let middle = ratios.as_deref().and_then(|ratios| median(ratios).ok());
        let counts = ratios.map(|ratios| {
            let slower = ratios.iter().filter(|ratio| **ratio > 1.0).count();
            let ties = ratios.iter().filter(|ratio| **ratio == 1.0).count();
            (slower as u64, (ratios.len() - ties) as u64)
        });
        Some(RunnerUp {
            setting: other.title().to_owned(),
            time_ratio: middle.or_else(|| self.by_yardstick(other, fastest))?,
            slower_blocks: counts.map(|(slower, _)| slower),
            blocks: counts.map(|(_, all)| all),
            by_chance: counts.map(|(slower, all)| sign_test(slower, all)),
        })
    }

    /// The time of `a` over that of `b`, both first held against the yardstick.
    fn by_yardstick(&self, a: &StrategyReport, b: &StrategyReport) -> Option<f64> {
        let ratio = self.clock.time(a)? / self.clock.time(b)?;
        ratio.is_finite().then_some(ratio)
    }

    /// The same block by block, where both have series.
    fn blocks(&self, a: &StrategyReport, b: &StrategyReport) -> Option<Vec<f64>> {
        let ratios = block_ratios(&a.frames.frame_ms, &b.frames.frame_ms, self.block).ok()?;
        ratios
            .iter()
            .all(|ratio| ratio.is_finite())
            .then_some(ratios)
    }
}
