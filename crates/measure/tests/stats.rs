//! Properties of the statistics.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_measure::stats::{
    block_ratios, longest_run, mean, median, noise_p95, percentile, ratio_of_sums, sign_test,
};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

fn values() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(1e-3..1e6f64, 1..60)
}

proptest! {
    #[test]
    fn the_median_has_as_many_values_below_as_above(values in values()) {
        let m = median(&values).unwrap();
        let below = values.iter().filter(|v| **v < m).count();
        let above = values.iter().filter(|v| **v > m).count();
        prop_assert!(below * 2 <= values.len() && above * 2 <= values.len());
    }

    #[test]
    fn percentiles_ascend_from_the_smallest_to_the_largest(values in values(), a in 0.0..100.0f64, b in 0.0..100.0f64) {
        let (low, high) = (a.min(b), a.max(b));
        let at = |p| percentile(&values, p).unwrap();
        prop_assert!(at(0.0) <= at(low) && at(low) <= at(high) && at(high) <= at(100.0));
        prop_assert_eq!(at(0.0), values.iter().copied().fold(f64::INFINITY, f64::min));
        prop_assert_eq!(at(100.0), values.iter().copied().fold(0.0, f64::max));
        prop_assert_eq!(at(50.0), median(&values).unwrap());
    }

    #[test]
    fn the_order_of_the_values_does_not_matter(mut values in values(), p in 0.0..100.0f64) {
        let before = percentile(&values, p).unwrap();
        values.reverse();
        prop_assert_eq!(before, percentile(&values, p).unwrap());
    }

    #[test]
    fn the_mean_lies_within_the_values(values in values()) {
        let m = mean(&values).unwrap();
        prop_assert!(percentile(&values, 0.0).unwrap() <= m * (1.0 + 1e-12));
        prop_assert!(m <= percentile(&values, 100.0).unwrap() * (1.0 + 1e-12));
    }

    #[test]
    fn a_strategy_that_takes_k_times_as_long_has_the_ratio_k(base in values(), k in 0.1..10.0f64, block in 1usize..20) {
        let times: Vec<f64> = base.iter().map(|t| t * k).collect();
        let ratios = block_ratios(&times, &base, block).unwrap();
        prop_assert_eq!(ratios.len(), base.len().div_ceil(block));
        for ratio in ratios {
            prop_assert!((ratio / k - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn sums_have_the_ratio_k_too_and_no_error_where_every_block_has_it(base in values(), k in 0.1..10.0f64, block in 1usize..20) {
        let times: Vec<f64> = base.iter().map(|t| t * k).collect();
        let sums = ratio_of_sums(&times, &base, block).unwrap();
        prop_assert!((sums.ratio / k - 1.0).abs() < 1e-9 && sums.standard_error < 1e-9);
    }

    #[test]
    fn a_drift_of_the_machine_does_not_reach_the_ratio(base in values(), block in 1usize..20) {
        // The machine slows down from block to block, for both alike.
        let slow = |values: &[f64], k: f64| -> Vec<f64> {
            values.iter().enumerate().map(|(i, t)| t * k * (1 + i / block) as f64).collect()
        };
        for ratio in block_ratios(&slow(&base, 0.5), &slow(&base, 1.0), block).unwrap() {
            prop_assert!((ratio - 0.5).abs() < 1e-9);
        }
    }

    #[test]
    fn noise_is_the_same_from_both_sides_and_at_least_one(ratios in prop::collection::vec(0.5..2.0f64, 1..40)) {
        let noise = noise_p95(&ratios).unwrap();
        let other: Vec<f64> = ratios.iter().map(|r| r.recip()).collect();
        prop_assert!(noise >= 1.0);
        prop_assert!((noise - noise_p95(&other).unwrap()).abs() < 1e-9);
    }

    #[test]
    fn the_longest_run_is_found_by_splitting(frames in prop::collection::vec(any::<bool>(), 0..80)) {
        let expected = frames.split(|bad| !bad).map(|run| run.len() as u64).max().unwrap_or(0);
        prop_assert_eq!(longest_run(frames), expected);
    }
}

#[test]
fn known_values() {
    assert_eq!(median(&[3.0, 1.0, 2.0]).unwrap(), 2.0);
    assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]).unwrap(), 2.5);
    let hundred: Vec<f64> = (0..=100).map(f64::from).collect();
    assert_eq!(percentile(&hundred, 95.0).unwrap(), 95.0);
    assert_eq!(mean(&[f64::MAX, f64::MAX]).unwrap(), f64::MAX);
    assert_eq!(
        median(&[f64::MAX, f64::MAX, -f64::MAX, f64::MAX]).unwrap(),
        f64::MAX
    );
}

#[test]
fn what_has_no_answer_is_refused_with_the_place() {
    let says = |error: antumbra_measure::MeasureError, word: &str| {
        let text = error.to_string();
        assert!(text.contains(word), "{text}");
    };
    says(median(&[]).unwrap_err(), "no values");
    says(median(&[1.0, f64::NAN]).unwrap_err(), "value 1");
    says(percentile(&[1.0], 101.0).unwrap_err(), "101");
    says(percentile(&[1.0], f64::NAN).unwrap_err(), "NaN");
    says(
        block_ratios(&[1.0, 2.0], &[1.0], 1).unwrap_err(),
        "2 times against 1",
    );
    says(block_ratios(&[1.0], &[1.0], 0).unwrap_err(), "block");
    says(ratio_of_sums(&[1.0], &[1.0], 0).unwrap_err(), "block");
    says(ratio_of_sums(&[1.0], &[0.0], 1).unwrap_err(), "sums to 0");
    says(
        block_ratios(&[1.0, 1.0], &[1.0, 0.0], 1).unwrap_err(),
        "block 1",
    );
    says(noise_p95(&[1.0, 0.0]).unwrap_err(), "ratio 1");
    says(noise_p95(&[f64::INFINITY]).unwrap_err(), "value 0");
}

#[test]
fn the_sign_test_counts_coins() {
    // Six of six: 1 of 64 outcomes. Five or more: 7.
    for (heads, all, chance) in [
        (6, 6, 1.0 / 64.0),
        (5, 6, 7.0 / 64.0),
        (0, 6, 1.0),
        (1, 1, 0.5),
        (0, 0, 1.0),
        (3, 5, 0.5),
        (7, 6, 0.0),
    ] {
        let tested = sign_test(heads, all);
        assert!(
            (tested - chance).abs() < 1e-12,
            "{heads} of {all}: {tested}"
        );
    }
    // 0.5 to this power underflows. Two standard deviations above the mean.
    let tested = sign_test(5_100, 10_000);
    assert!((0.02..0.025).contains(&tested), "{tested}");
    assert_eq!(sign_test(10_000, 10_000), 0.0);
}

#[test]
fn the_error_of_a_ratio_of_sums_is_how_much_it_varies_from_run_to_run() {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let mut run = || {
        let (mut times, mut baseline) = (Vec::new(), Vec::new());
        for _ in 0..60 {
            let block: f64 = random.random_range(5.0..50.0);
            times.extend([0.9 * block * random.random_range(0.7..1.3); 5]);
            baseline.extend([block * random.random_range(0.7..1.3); 5]);
        }
        ratio_of_sums(&times, &baseline, 5).unwrap()
    };
    let (ratios, errors): (Vec<f64>, Vec<f64>) = (0..500)
        .map(|_| run())
        .map(|run| (run.ratio, run.standard_error))
        .unzip();
    let middle = mean(&ratios).unwrap();
    let squares: Vec<f64> = ratios
        .iter()
        .map(|ratio| (ratio - middle).powi(2))
        .collect();
    let (spread, error) = (mean(&squares).unwrap().sqrt(), mean(&errors).unwrap());
    assert!((middle - 0.9).abs() < 0.01, "{middle}");
    assert!((error / spread - 1.0).abs() < 0.15, "{error} of {spread}");
}
