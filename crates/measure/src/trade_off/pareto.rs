//! The efficient pareto_front (Pareto's front): the settings than which none is both faster and no worse.

use super::settings;
use super::speed::SpeedComparison;
use crate::report::{Report, StrategyReport};

/// The settings of a report on the efficient pareto_front of time and mean wrong pixels, the most right
/// first: each that follows has more wrong pixels and is faster, beyond what the noise can tell,
/// than the one before. Yardsticks do not compete.
///
/// No setting that was measured is both faster and no more wrong than one of these, nor as fast and
/// less wrong. What is missing is either beaten by one of them, or buys for its errors no speed that
/// the noise could not explain. Of exact equals the first stays.
pub fn pareto_front(report: &Report) -> Vec<&StrategyReport> {
    let race = SpeedComparison::of(report);
    let measured: Vec<_> = settings(report)
        .filter(|(s, _)| s.error.wrong_pixels_percent.mean.is_finite())
        .collect();
    let places: Vec<(f64, f64)> = measured
        .iter()
        .map(|(s, time)| (*time, s.error.wrong_pixels_percent.mean))
        .collect();
    let mut pareto_front: Vec<&StrategyReport> = Vec::new();
    for at in front(&places) {
        let Some((setting, _)) = measured.get(at) else {
            continue;
        };
        if pareto_front
            .last()
            .is_none_or(|last| race.faster(setting, last))
        {
            pareto_front.push(setting);
        }
    }
    pareto_front
}

/// Which of these costs, each a time and an error, no other undercuts in one without exceeding it in
/// the other: by falling time and rising error. Of equals the first.
pub(crate) fn front(costs: &[(f64, f64)]) -> Vec<usize> {
    let mut sorted: Vec<(usize, (f64, f64))> = costs.iter().copied().enumerate().collect();
    // Stable, so that the first of equals comes first.
    sorted.sort_by(|(_, a), (_, b)| a.1.total_cmp(&b.1).then(a.0.total_cmp(&b.0)));
    let mut fastest = f64::INFINITY;
    sorted.retain(|(_, (time, _))| {
        let extends = *time < fastest;
        fastest = fastest.min(*time);
        extends
    });
    sorted.into_iter().map(|(at, _)| at).collect()
}

#[cfg(test)]
mod tests {
    use super::front;

    #[test]
    fn the_front_holds_what_nothing_beats_on_both_counts() {
        let costs = [
            (0.25, 1.0), // fast and wrong
            (1.0, 0.0),  // slow and right
            (0.5, 0.5),  // beaten
            (0.3, 0.1),  // better
            (2.0, 0.0),  // slower and as right
            (0.3, 0.1),  // better, once more
        ];
        assert_eq!(front(&costs), [1, 3, 0]);
        assert_eq!(front(&[]), [] as [usize; 0]);
        assert_eq!(front(&[(1.0, 0.0)]), [0]);
    }
}
