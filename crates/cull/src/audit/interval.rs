//! From a sample of patches to an interval for the whole: the bound that auditors use for account books in which few entries are wrong, and
//! those mostly in part (Stringer, *Practical Aspects of Statistical Sampling in Auditing*, 1963; Bickel, *Inference and Auditing:
//! The Stringer Bound*, 1992). A normal interval would be of no width where a sample found nothing, which most samples do.

use super::FrameAudit;

/// A share of wrong pixels, in percent of a view's pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Unbiased: its expectation is the truth.
    pub percent: f64,
    /// The lower end of the interval that holds the truth with [`Self::CONFIDENCE`].
    pub low: f64,
    /// The upper end; 100 where nothing was sampled.
    pub high: f64,
}

/// The normal quantile of each side of [`Estimate::CONFIDENCE`].
const Z: f64 = 1.959_964;
/// The probability beyond each end.
const LEFT_OUT: f64 = 0.025;

impl Estimate {
    /// The least probability that the interval holds the truth.
    pub const CONFIDENCE: f64 = 0.95;

    /// Whether the interval holds a value.
    pub fn holds(&self, percent: f64) -> bool {
        // A count is a sum of fractions by the time it is compared.
        let slack = 1e-9 * percent.abs();
        self.low <= percent + slack && percent - slack <= self.high
    }

    /// The mean over some frames.
    pub(super) fn of<'a>(frames: impl Iterator<Item = &'a FrameAudit>) -> Self {
        let mut hits: Vec<f64> = Vec::new();
        let mut sizes: Vec<Size> = Vec::new();
        let mut pixels = 0.0_f64;
        for frame in frames {
            pixels += frame.pixels;
            sizes.push(Size {
                heaviest: unit(frame),
                pixels: frame.pixels,
            });
            let found = frame.hits.iter().map(|hit| hit.pixels);
            // Where whole frames are sampled, all hits of a frame are found or missed together.
            match frame.frame_share < 1.0 && !frame.hits.is_empty() {
                true => hits.push(found.sum()),
                false => hits.extend(found),
            }
        }
        if pixels == 0.0 {
            return Self {
                percent: 0.0,
                low: 0.0,
                high: 100.0,
            };
        }
        hits.sort_unstable_by(|a, b| b.total_cmp(a));
        let found: f64 = hits.iter().sum();
        let percent = |of: f64| (of / pixels * 100.0).clamp(0.0, 100.0);
        if sizes.iter().all(|frame| frame.heaviest == 0.0) {
            let all = percent(found);
            return Self {
                percent: all,
                low: all,
                high: all,
            };
        }
        // The j-th largest hit is weighted by what a j-th hit adds to the bound of a Poisson count. Largest first is the conservative order for both ends.
        let (mut low, mut high) = (0.0, unseen(sizes));
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

/// Wrong pixels of a frame that are hit once on average, or that hide as well as if they were: where each frame is sampled, what a wholly wrong patch stands for.
/// Where a part p of the frames is sampled, W wrong ones go unhit with a chance of 1 - p + p exp(-W / (p M)); its logarithm is convex in W, so its chord over all of
/// a frame's pixels bounds it.
fn unit(frame: &FrameAudit) -> f64 {
    let (frame_share, pixels) = (frame.frame_share, frame.pixels);
    if frame_share >= 1.0 || frame.heaviest <= 0.0 {
        return frame.heaviest;
    }
    let unhit = 1.0 - frame_share + frame_share * (-pixels / (frame_share * frame.heaviest)).exp();
    pixels / -unhit.ln()
}

/// What a frame may hide: the pixels that are hit once on average, and all its pixels.
#[derive(Debug, Clone, Copy)]
struct Size {
    heaviest: f64,
    pixels: f64,
}

/// The most wrong pixels that all frames together may have with a probability of [`LEFT_OUT`] that none is found. W of them in a frame are hit W / heaviest
/// times on average, so they hide best where patches are heaviest; but no frame holds more than it has pixels. (Stringer takes the heaviest
/// of all for every frame: the same where all are alike.)
fn unseen(mut frames: Vec<Size>) -> f64 {
    frames.sort_unstable_by(|a, b| b.heaviest.total_cmp(&a.heaviest));
    let mut left = most(0);
    let mut wrong = 0.0;
    for Size { heaviest, pixels } in frames {
        if heaviest <= 0.0 {
            break;
        }
        let here = pixels.min(left * heaviest);
        wrong += here;
        left -= here / heaviest;
    }
    wrong
}

/// The largest mean of a Poisson count with which so small a count still has a probability of [`LEFT_OUT`]: exact for none, else by Wilson and
/// Hilferty's cube root (*The Distribution of Chi-Square*, 1931), good to a third of a percent.
fn most(count: u32) -> f64 {
    match count {
        0 => -LEFT_OUT.ln(),
        _ => cubed(f64::from(count) + 1.0, Z) * 1.003,
    }
}

/// The smallest mean with which so large a count still has that probability; never too large.
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
            sampled: true,
            frame_share: 1.0,
            hits: hits
                .iter()
                .map(|pixels| Hit {
                    pixels: *pixels,
                    uncertain: false,
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
    fn frames_that_were_hardly_looked_at_hide_no_more_than_they_have() {
        let mut frames = vec![frame(1_000.0, &[]); 1_000];
        let alike = Estimate::of(frames.iter());
        for hardly in frames.iter_mut().take(3) {
            hardly.heaviest = 1e7;
        }
        let mixed = Estimate::of(frames.iter());
        // Three whole frames of a thousand, and a little more than what bounds the rest.
        assert!(
            alike.high < mixed.high && mixed.high < alike.high + 0.3,
            "{alike:?} {mixed:?}"
        );
    }

    #[test]
    fn whole_frames_that_nobody_looked_at_may_be_wrong() {
        use rand::{RngExt, SeedableRng};
        let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(6);
        let often = 0.25;
        // A patch that is wrong all over stands for a hundredth of the image times 4; frames are right or wrong all over.
        for wrong_frames in [1, 8, 12, 40, 200] {
            let truth = f64::from(wrong_frames) / 400.0 * 100.0;
            let mut held = 0;
            for _ in 0..1_000 {
                let frames: Vec<FrameAudit> = (0..400)
                    .map(|number| {
                        let seen = random.random_bool(often) && number < wrong_frames;
                        let hits: &[f64] = if seen { &[400.0; 100] } else { &[] };
                        FrameAudit {
                            frame_share: often,
                            ..frame(400.0, hits)
                        }
                    })
                    .collect();
                held += u32::from(Estimate::of(frames.iter()).holds(truth));
            }
            assert!(held >= 950, "{wrong_frames}: {held} of 1,000");
        }
    }

    #[test]
    fn whoever_hides_where_patches_are_heaviest_is_seen_as_often_as_claimed() {
        use rand::{RngExt, SeedableRng};
        let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(5);
        // Ten frames whose patches stand for much among ninety that stand for less; as much wrong in the heavy ones as is hardly ever seen, half a patch each.
        let (heavy, light) = (12_800.0_f64, 1_280.0);
        for wrong_frames in [1, 3, 5, 8] {
            let truth = f64::from(wrong_frames) * 5_000.0 / (100.0 * 10_000.0) * 100.0;
            let mut held = 0;
            for _ in 0..2_000 {
                let frames: Vec<FrameAudit> = (0..100)
                    .map(|number| {
                        let heaviest = if number < 10 { heavy } else { light };
                        // Patches half wrong, each of which stands for half of `heaviest` where it is drawn.
                        let chance = 5_000.0 / (heaviest / 2.0);
                        let hit = number < wrong_frames && random.random_bool(chance.min(1.0));
                        frame(heaviest, if hit { &[6_400.0] } else { &[] })
                    })
                    .collect();
                held += u32::from(Estimate::of(frames.iter()).holds(truth));
            }
            assert!(held >= 1_900, "{wrong_frames}: {held} of 2,000");
        }
    }

    #[test]
    fn nothing_looked_at_says_nothing() {
        let nothing = Estimate::of(std::iter::empty());
        assert!(nothing.holds(0.0) && nothing.holds(100.0));
    }
}
