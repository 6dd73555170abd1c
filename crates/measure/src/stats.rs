//! The statistics of a comparison: medians, percentiles, ratios by block, and runs of frames.
//!
//! Strategies are measured in blocks of consecutive poses and in rotation, so that temperature, clock rates and other load on the machine
//! affect all of them alike. A ratio is taken within a block, where both strategies ran under the same conditions; the result is the median
//! over the blocks.

use crate::MeasureError;

/// The median; for an even number of values, the mean of the middle two.
///
/// # Errors
/// No values, or one that is not finite.
pub fn median(values: &[f64]) -> Result<f64, MeasureError> {
    quantile("median", values, 0.5)
}

/// The value below which `percent` of 100 of the values lie, linear between neighbours (Hyndman and
/// Fan's type 7): 0 is the smallest, 100 the largest.
///
/// # Errors
/// No values, one that is not finite, or `percent` outside 0 to 100.
pub fn percentile(values: &[f64], percent: f64) -> Result<f64, MeasureError> {
    if !(0.0..=100.0).contains(&percent) {
        return Err(wrong(
            "percentile",
            format!("{percent} is not within 0 to 100"),
        ));
    }
    quantile("percentile", values, percent / 100.0)
}

/// The arithmetic mean.
///
/// # Errors
/// No values, or one that is not finite.
pub fn mean(values: &[f64]) -> Result<f64, MeasureError> {
    checked("mean", values)?;
    // A running mean stays within the values' range where a sum could overflow.
    Ok(values
        .iter()
        .zip(1u64..)
        .fold(0.0, |mean, (value, n)| mean + (value - mean) / n as f64))
}

/// The ratio of the medians of each block: `times` over `baseline`, both with one value for each pose, in path order and of the same poses. A
/// last block that is not full counts as a block.
///
/// # Errors
/// Different lengths, a block length of 0, no values, one that is not finite, or a block whose
/// baseline has a median of 0 or less.
pub fn block_ratios(
    times: &[f64],
    baseline: &[f64],
    block: usize,
) -> Result<Vec<f64>, MeasureError> {
    const NAME: &str = "block ratios";
    pairs(NAME, times, baseline, block)?;
    times
        .chunks(block)
        .zip(baseline.chunks(block))
        .enumerate()
        .map(|(i, (times, baseline))| {
            let below = median(baseline)?;
            if below <= 0.0 {
                return Err(wrong(
                    NAME,
                    format!("block {i} of the baseline took {below} ms"),
                ));
            }
            Ok(median(times)? / below)
        })
        .collect()
}

/// A ratio with its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RatioEstimate {
    /// The ratio.
    pub ratio: f64,
    /// Its standard error, in the ratio's own unit; 0 where it cannot be told.
    pub standard_error: f64,
}

/// The ratio of the sums of two series, `times` over `baseline`, measured at the same poses. Sums show what only a few frames cost, which
/// medians do not. The standard error is that over blocks of poses; for a single block it is 0.
///
/// Cochran, *Sampling Techniques*, 3rd edition, 1977, chapter 6: the ratio estimator.
///
/// # Errors
/// As for [`block_ratios`], except that a block of the baseline may sum to 0, as long as not all blocks do.
pub fn ratio_of_sums(
    times: &[f64],
    baseline: &[f64],
    block: usize,
) -> Result<RatioEstimate, MeasureError> {
    const NAME: &str = "ratio of sums";
    pairs(NAME, times, baseline, block)?;
    let below: f64 = baseline.iter().sum();
    if !(below > 0.0 && below.is_finite()) {
        return Err(wrong(NAME, format!("the baseline sums to {below} ms")));
    }
    let ratio = times.iter().sum::<f64>() / below;
    let blocks = times.chunks(block).zip(baseline.chunks(block));
    let squares = blocks.map(|(times, baseline)| {
        (times.iter().sum::<f64>() - ratio * baseline.iter().sum::<f64>()).powi(2)
    });
    let (squares, count): (f64, f64) = (squares.sum(), times.len().div_ceil(block) as f64);
    let standard_error = match count > 1.0 {
        true => (squares * count / (count - 1.0)).sqrt() / below,
        false => 0.0,
    };
    Ok(RatioEstimate {
        ratio,
        standard_error,
    })
}

/// The noise of an A/A run, in which the same strategy was measured twice: the 95th percentile of its block ratios, each inverted if it is
/// below 1. A smaller difference between strategies is not significant.
///
/// # Errors
/// No ratios, or one that is not finite and positive.
pub fn noise_p95(ratios: &[f64]) -> Result<f64, MeasureError> {
    if let Some(i) = ratios.iter().position(|ratio| *ratio <= 0.0) {
        return Err(wrong("noise", format!("ratio {i} is not positive")));
    }
    let factors: Vec<f64> = ratios
        .iter()
        .map(|ratio| ratio.max(ratio.recip()))
        .collect();
    quantile("noise", &factors, 0.95)
}

/// The one-sided sign test: the probability that at least `heads` of `all` fair coins show heads; 1 for no coins. With blocks as coins, it is
/// the probability that a strategy of equal speed is the slower one this often.
///
/// John Arbuthnot, "An Argument for Divine Providence", 1710.
pub fn sign_test(heads: u64, all: u64) -> f64 {
    if heads == 0 {
        return 1.0;
    }
    // Logarithms, since 0.5 to the power of some thousands underflows.
    let (mut ways, mut sum) = (-(all as f64) * std::f64::consts::LN_2, 0.0);
    for heads in (heads..=all).rev() {
        sum += ways.exp();
        ways += (heads as f64).ln() - ((all - heads + 1) as f64).ln();
    }
    sum.clamp(0.0, 1.0)
}

/// The length of the longest run of consecutive frames that are `true`.
pub fn longest_run(frames: impl IntoIterator<Item = bool>) -> u64 {
    let (longest, _) = frames
        .into_iter()
        .fold((0u64, 0u64), |(longest, run), bad| {
            let run = if bad { run + 1 } else { 0 };
            (longest.max(run), run)
        });
    longest
}

fn quantile(name: &'static str, values: &[f64], q: f64) -> Result<f64, MeasureError> {
    checked(name, values)?;
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let place = q * (sorted.len() - 1) as f64;
    let (below, above) = (place.floor() as usize, place.ceil() as usize);
    match (sorted.get(below), sorted.get(above)) {
        // Interpolation as a weighted sum, since the difference of two large values could overflow.
        (Some(&a), Some(&b)) if a < b => {
            let t = place - below as f64;
            Ok((a * (1.0 - t) + b * t).clamp(a, b))
        }
        (Some(&a), _) => Ok(a),
        (None, _) => Err(wrong(name, "there are no values".to_owned())),
    }
}

/// Checks that two series can be compared by block.
fn pairs(
    name: &'static str,
    times: &[f64],
    baseline: &[f64],
    block: usize,
) -> Result<(), MeasureError> {
    if times.len() != baseline.len() {
        return Err(wrong(
            name,
            format!(
                "{} times against {} of the baseline",
                times.len(),
                baseline.len()
            ),
        ));
    }
    if block == 0 {
        return Err(wrong(name, "a block has no poses".to_owned()));
    }
    checked(name, times)?;
    checked(name, baseline)
}

fn checked(name: &'static str, values: &[f64]) -> Result<(), MeasureError> {
    if values.is_empty() {
        return Err(wrong(name, "there are no values".to_owned()));
    }
    match values.iter().position(|value| !value.is_finite()) {
        Some(i) => Err(wrong(name, format!("value {i} is not a finite number"))),
        None => Ok(()),
    }
}

fn wrong(statistic: &'static str, problem: String) -> MeasureError {
    MeasureError::Statistics { statistic, problem }
}
