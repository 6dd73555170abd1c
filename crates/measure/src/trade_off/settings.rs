//! The settings of a sweep with their times.

use super::time_base::TimeBase;
use crate::report::{Report, StrategyReport};

/// A setting that was timed.
#[derive(Debug, Clone, Copy)]
pub(super) struct TimedSetting<'a> {
    pub setting: &'a StrategyReport,
    /// Its time, by the report's [`TimeBase`].
    pub time: f64,
}

/// The settings of a report: its strategies that are no yardsticks and were timed.
pub(super) fn settings(report: &Report) -> impl Iterator<Item = TimedSetting<'_>> {
    let base = TimeBase::of(report);
    let measured = report.strategies.iter().filter(|s| !s.is_yardstick());
    measured.filter_map(move |setting| {
        let time = base.time(setting)?;
        Some(TimedSetting { setting, time })
    })
}
