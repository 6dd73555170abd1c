//! The Pareto front of a sweep's settings, in time and error.

use super::settings::{TimedSetting, settings};
use super::speed::SpeedComparison;
use crate::report::{Report, StrategyReport};

/// The settings of a report on the Pareto front of time and mean wrong pixels (by [`Report::error_basis`]), the most accurate first. Each has more wrong pixels than the one
/// before it and is significantly faster. Yardsticks are left out.
///
/// No measured setting is faster than one of these without more wrong pixels, or has fewer wrong pixels without being slower. A setting that is
/// left out is dominated by one of these, or is not significantly faster for its additional error. Of exactly equal settings the first
/// stays.
pub fn pareto_front(report: &Report) -> Vec<&StrategyReport> {
    let speeds = SpeedComparison::of(report);
    let basis = report.error_basis();
    let error = |setting: &StrategyReport| setting.error.wrong(basis).mean;
    let measured: Vec<_> = settings(report)
        .filter(|timed| error(timed.setting).is_finite())
        .collect();
    let costs: Vec<Cost> = measured
        .iter()
        .map(|TimedSetting { setting, time }| Cost {
            time: *time,
            error: error(setting),
        })
        .collect();
    let mut on_front: Vec<&StrategyReport> = Vec::new();
    for at in front(&costs) {
        let Some(TimedSetting { setting, .. }) = measured.get(at) else {
            continue;
        };
        if on_front
            .last()
            .is_none_or(|last| speeds.faster(setting, last))
        {
            on_front.push(setting);
        }
    }
    on_front
}

/// The costs of a setting. Less is better, in any unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cost {
    pub time: f64,
    pub error: f64,
}

/// The indices of the costs that no other cost dominates, by rising error and falling time. Of equal costs the first.
pub(crate) fn front(costs: &[Cost]) -> Vec<usize> {
    let mut sorted: Vec<(usize, Cost)> = costs.iter().copied().enumerate().collect();
    // Stable, so that the first of equal costs comes first.
    sorted.sort_by(|(_, a), (_, b)| a.error.total_cmp(&b.error).then(a.time.total_cmp(&b.time)));
    let mut fastest = f64::INFINITY;
    sorted.retain(|(_, cost)| {
        let extends = cost.time < fastest;
        fastest = fastest.min(cost.time);
        extends
    });
    sorted.into_iter().map(|(at, _)| at).collect()
}

#[cfg(test)]
mod tests {
    use super::{Cost, front};

    #[test]
    fn the_front_holds_what_nothing_beats_on_both_counts() {
        let costs = [
            (0.25, 1.0), // fast and inaccurate
            (1.0, 0.0),  // slow and accurate
            (0.5, 0.5),  // dominated
            (0.3, 0.1),  // better
            (2.0, 0.0),  // slower and as accurate
            (0.3, 0.1),  // equal to another
        ]
        .map(|(time, error)| Cost { time, error });
        assert_eq!(front(&costs), [1, 3, 0]);
        assert_eq!(front(&[]), [] as [usize; 0]);
        assert_eq!(front(&costs[1..2]), [0]);
    }
}
