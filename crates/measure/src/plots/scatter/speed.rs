//! Speed as the plot says it: the inverse of a time.

use crate::report::StrategyReport;
use crate::trade::Clock;
use crate::words;

/// What speed is measured by.
#[derive(Clone, Copy)]
pub(super) struct Speed(pub(super) Clock);

impl Speed {
    /// How many times as fast as the yardstick, or frames per second; 0 for what was not timed.
    pub(super) fn get(self, strategy: &StrategyReport) -> f64 {
        match (self.0, self.0.time(strategy)) {
            (Clock::Alone, _) => 1000.0 / strategy.frame_ms.median.max(1e-6),
            (_, time) => time.map_or(0.0, f64::recip),
        }
    }

    pub(super) fn means(self) -> &'static str {
        match self.0 {
            Clock::VsFrustum => {
                "speed: how many times as fast as frustum culling alone (further right is better)"
            }
            Clock::VsNone => {
                "speed: how many times as fast as no culling (further right is better)"
            }
            Clock::Alone => "speed: frames per second (further right is better)",
        }
    }

    pub(super) fn word(self, value: f64) -> String {
        match self.0 {
            Clock::Alone => words::trimmed(value),
            _ => format!("{}x", words::trimmed(value)),
        }
    }
}
