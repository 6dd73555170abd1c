//! From what a sample of patches showed to an interval for the whole: the bound that auditors use for account books in which few entries are
//! wrong, and those mostly in part (Stringer, *Practical Aspects of Statistical Sampling in Auditing*, 1963; Bickel, *Inference and Auditing:
//! The Stringer Bound*, 1992). A normal interval would be of no width where a sample found nothing, which most samples do.

use super::FrameAudit;

/// A share of wrong pixels, in percent of a view's pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Unbiased: its mean over all lots is the truth.
    pub percent: f64,
    /// With [`Self::CONFIDENCE`] the truth lies at or above this,
    pub low: f64,
    /// and at or below this. 100 where nothing was looked at.
    pub high: f64,
}

/// The normal quantile of each side of [`Estimate::CONFIDENCE`].
const Z: f64 = 1.959_964;
/// What each side leaves out.
const LEFT_OUT: f64 = 0.025;

impl Estimate {
    /// How often the truth lies within, at least.
    pub const CONFIDENCE: f64 = 0.95;

    /// Whether a truth lies within.
    pub fn holds(&self, percent: f64) -> bool {
        // A count is a sum of fractions by the time it is compared.
        let slack = 1e-9 * percent.abs();
        self.low <= percent + slack && percent - slack <= self.high
    }

    /// The mean over some frames.
    pub(super) fn of<'a>(frames: impl Iterator<Item = &'a FrameAudit>) -> Self {
        let mut hits: Vec<f64> = Vec::new();
        let (mut number, mut pixels, mut heaviest) = (0.0, 0.0_f64, 0.0_f64);
        for frame in frames {
            number += 1.0;
            pixels += frame.pixels;
            heaviest = heaviest.max(frame.heaviest);
            hits.extend(frame.hits.iter().map(|hit| hit.pixels));
        }
        if number == 0.0 || pixels == 0.0 {
            return Self {
                percent: 0.0,
                low: 0.0,
                high: 100.0,
            };
        }
        hits.sort_unstable_by(|a, b| b.total_cmp(a));
        let found: f64 = hits.iter().sum();
        let percent = |of: f64| (of / pixels * 100.0).clamp(0.0, 100.0);
        if heaviest == 0.0 {
            let all = percent(found);
            return Self {
                percent: all,
                low: all,
                high: all,
            };
        }
        // The j-th largest hit counts by what a j-th hit adds to the bound of a Poisson count; largest first is the careful way for both sides.
        let (mut low, mut high) = (0.0, heaviest * most(0));
        for (hit, number) in hits.iter().zip(1u32..) {
            low += hit * (least(number) - least(number - 1));
            high += hit * (most(number) - most(number - 1));
        }
        Self {
            percent: percent(found),
            low: percent(low.min(found)),
            high: percent(high),
        }
    }
}

/// The largest mean of a Poisson count that would still bring so few with a chance of [`LEFT_OUT`]: exact for none, else by Wilson and
/// Hilferty's cube root (*The Distribution of Chi-Square*, 1931), good to a third of a percent.
fn most(count: u32) -> f64 {
    match count {
        0 => -LEFT_OUT.ln(),
        _ => cubed(f64::from(count) + 1.0, Z) * 1.003,
    }
}

/// The least mean that would still bring so many, never too large.
fn least(count: u32) -> f64 {
    match count {
        0 => 0.0,
        _ => cubed(f64::from(count), -Z),
    }
}

fn cubed(count: f64, z: f64) -> f64 {
    count * (1.0 - (9.0 * count).recip() + z / (3.0 * count.sqrt())).powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Hit;

    fn poisson_at_most(count: u32, mean: f64) -> f64 {
        let mut term = (-mean).exp();
        let mut sum = term;
        for number in 1..=count {
            term *= mean / f64::from(number);
            sum += term;
        }
        sum
    }

    #[test]
    fn the_bounds_of_a_poisson_count_leave_out_no_more_than_they_say() {
        for count in 0..200 {
            let above = poisson_at_most(count, most(count));
            assert!(
                above <= LEFT_OUT * 1.0001 && above > 0.02,
                "{count}: {above}"
            );
            let below = 1.0 - poisson_at_most(count.saturating_sub(1), least(count));
            assert!(count == 0 || below <= LEFT_OUT * 1.001, "{count}: {below}");
        }
    }

    fn frame(heaviest: f64, hits: &[f64]) -> FrameAudit {
        FrameAudit {
            pixels: 10_000.0,
            heaviest,
            hits: hits
                .iter()
                .map(|pixels| Hit {
                    pixels: *pixels,
                    doubtful: false,
                })
                .collect(),
            ..FrameAudit::default()
        }
    }

    #[test]
    fn no_hit_bounds_by_three_and_a_bit_patches_worth() {
        let none = frame(100.0, &[]).wrong_pixels_percent();
        assert_eq!((none.percent, none.low), (0.0, 0.0));
        assert!((none.high - 3.689).abs() < 1e-3, "{none:?}");
    }

    #[test]
    fn what_was_looked_at_whole_is_known() {
        let all = frame(0.0, &[3.0, 7.0]).wrong_pixels_percent();
        assert_eq!((all.percent, all.low, all.high), (0.1, 0.1, 0.1));
        assert!(all.holds(0.1) && !all.holds(0.1001));
    }

    #[test]
    fn more_frames_narrow_the_interval() {
        let frames = vec![frame(400.0, &[50.0]); 100];
        let one = Estimate::of(frames.iter().take(1));
        let many = Estimate::of(frames.iter());
        assert_eq!(one.percent, many.percent);
        assert!(many.high - many.low < 0.2 * (one.high - one.low));
        assert!(many.low > 0.0 && many.holds(0.5));
    }

    #[test]
    fn nothing_looked_at_says_nothing() {
        let nothing = Estimate::of(std::iter::empty());
        assert!(nothing.holds(0.0) && nothing.holds(100.0));
    }
}
