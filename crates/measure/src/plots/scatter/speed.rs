//! Speeds for the plot: inverses of times.

use crate::format;
use crate::report::StrategyReport;
use crate::trade_off::TimeBase;

/// The unit of speeds.
#[derive(Clone, Copy)]
pub(super) struct Speed(pub(super) TimeBase);

impl Speed {
    /// A strategy's speed: how many times as fast as the yardstick, or frames per second; 0 where it was not timed.
    pub(super) fn get(self, strategy: &StrategyReport) -> f64 {
        match (self.0, self.0.time(strategy)) {
            (TimeBase::Alone, _) => 1000.0 / strategy.frame_ms.median.max(1e-6),
            (_, time) => time.map_or(0.0, f64::recip),
        }
    }

    /// The axis's description.
    pub(super) fn means(self) -> &'static str {
        match self.0 {
            TimeBase::VsFrustum => {
                "speed: how many times as fast as frustum culling alone (further right is better)"
            }
            TimeBase::VsNone => {
                "speed: how many times as fast as no culling (further right is better)"
            }
            TimeBase::Alone => "speed: frames per second (further right is better)",
        }
    }

    /// A speed as text.
    pub(super) fn word(self, value: f64) -> String {
        match self.0 {
            TimeBase::Alone => format::trimmed(value),
            _ => format!("{}x", format::trimmed(value)),
        }
    }
}
