//! The base of comparison for the times of a report.

use crate::report::{Report, StrategyReport};

/// The best yardstick against which every strategy of a report was timed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TimeBase {
    VsFrustum,
    VsNone,
    /// No common yardstick: the frame times themselves.
    Alone,
}

impl TimeBase {
    /// The best base that all strategies of a report have.
    pub(crate) fn of(report: &Report) -> Self {
        let all = |base: Self| {
            report
                .strategies
                .iter()
                .all(|strategy| base.time(strategy).is_some())
        };
        [Self::VsFrustum, Self::VsNone]
            .into_iter()
            .find(|base| all(*base))
            .unwrap_or(Self::Alone)
    }

    /// A strategy's time over the yardstick's, or in milliseconds; `None` where it is no positive number.
    pub(crate) fn time(self, strategy: &StrategyReport) -> Option<f64> {
        let time = match self {
            Self::VsFrustum => strategy.time_vs_frustum,
            Self::VsNone => strategy.time_vs_none,
            Self::Alone => Some(strategy.frame_ms.median),
        };
        time.filter(|time| time.is_normal() && *time > 0.0)
    }
}
