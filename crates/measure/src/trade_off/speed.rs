//! Compares the speeds of settings, with significance.

use super::time_base::TimeBase;
use crate::report::{Report, RunnerUp, StrategyReport};
use crate::stats::{block_ratios, median, sign_test};

/// Compares speeds within one report.
pub(super) struct SpeedComparison {
    base: TimeBase,
    /// The ratio of times above which a difference is significant.
    noise: f64,
    /// Poses of a block.
    block: usize,
}

impl SpeedComparison {
    pub(super) fn of(report: &Report) -> Self {
        let frames = usize::try_from(report.scene.frames).unwrap_or(usize::MAX);
        let block = report.noise.block_frames.map(usize::try_from);
        Self {
            base: TimeBase::of(report),
            noise: report.noise.least_ratio(),
            block: block
                .and_then(Result::ok)
                .unwrap_or_else(|| crate::compare::usual_block(frames)),
        }
    }

    /// Whether `a` is significantly faster than `b`: by their times against the common yardstick, and by the median of their own block
    /// ratios. Both must exceed the noise.
    pub(super) fn faster(&self, a: &StrategyReport, b: &StrategyReport) -> bool {
        let beyond = |ratio: Option<f64>| ratio.is_some_and(|ratio| ratio > self.noise);
        beyond(self.by_yardstick(b, a))
            && self
                .blocks(b, a)
                .is_none_or(|ratios| beyond(median(&ratios).ok()))
    }

    /// How much slower `other` is than `fastest`.
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

    /// The time of `a` over that of `b`, both relative to the yardstick.
    fn by_yardstick(&self, a: &StrategyReport, b: &StrategyReport) -> Option<f64> {
        let ratio = self.base.time(a)? / self.base.time(b)?;
        ratio.is_finite().then_some(ratio)
    }

    /// The time of `a` over that of `b` for each block; `None` where one has no series.
    fn blocks(&self, a: &StrategyReport, b: &StrategyReport) -> Option<Vec<f64>> {
        let ratios = block_ratios(&a.frames.frame_ms, &b.frames.frame_ms, self.block).ok()?;
        ratios
            .iter()
            .all(|ratio| ratio.is_finite())
            .then_some(ratios)
    }
}
