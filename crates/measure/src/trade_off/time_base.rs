//! What the speeds of a report are told by.

use crate::report::{Report, StrategyReport};

/// The best yardstick that every strategy of a report was held against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TimeBase {
    VsFrustum,
    VsNone,
    /// No common yardstick: the frame time itself.
    Alone,
}

impl TimeBase {
    pub(crate) fn of(report: &Report) -> Self {
        let all = |clock: Self| {
            report
                .strategies
                .iter()
                .all(|strategy| clock.time(strategy).is_some())
        };
        [Self::VsFrustum, Self::VsNone]
            .into_iter()
            .find(|clock| all(*clock))
            .unwrap_or(Self::Alone)
    }

    /// The time as a part of the yardstick's, or in milliseconds; `None` where it is no positive
    /// number.
    pub(crate) fn time(self, strategy: &StrategyReport) -> Option<f64> {
        let time = match self {
            Self::VsFrustum => strategy.time_vs_frustum,
            Self::VsNone => strategy.time_vs_none,
            Self::Alone => Some(strategy.frame_ms.median),
        };
        time.filter(|time| time.is_normal() && *time > 0.0)
    }
}
