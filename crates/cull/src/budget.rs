//! A budget in place of settings: how much of the image may be wrong, or how long a frame may take. A controller changes the strategy's settings frame by frame, by what
//! the audit finds or by the frame times it is told.
//!
//! A strategy lists its [`Step`](crate::Step)s from the most accurate to the fastest ([`Tunable::steps`](crate::Tunable::steps)); a step may have a dial, which says how
//! much a frame may leave out. `docs/accuracy.md` has the measurements.

mod belief;
mod controller;
mod error;
mod time;

use std::fmt;
use std::str::FromStr;

pub(crate) use controller::BudgetController;
use thiserror::Error;

/// A budget for a stage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Budget {
    /// The mean of the wrong pixels over frames, in percent of a view's pixels: the stage is as fast as that allows. 0: conservative settings.
    WrongPixels(f64),
    /// Milliseconds a frame: the stage is as accurate as that allows.
    FrameTime(f64),
}

/// A text that is no budget.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("'{0}' is no budget: write wrong_pixels=0.02% (0 to 100), or frame_time=16.6ms (above 0)")]
pub struct BudgetError(String);

impl FromStr for Budget {
    type Err = BudgetError;

    fn from_str(text: &str) -> Result<Self, BudgetError> {
        let error = || BudgetError(text.to_owned());
        let (key, value) = text.split_once('=').ok_or_else(error)?;
        let number = |unit: &str| {
            let number = value.strip_suffix(unit).unwrap_or(value).trim();
            number.parse::<f64>().ok().filter(|it| it.is_finite())
        };
        match key {
            // 0 needs no unit.
            "wrong_pixels" if value.ends_with('%') || value == "0" => number("%")
                .filter(|percent| (0.0..=100.0).contains(percent))
                .map(Self::WrongPixels),
            "frame_time" if value.ends_with("ms") => {
                number("ms").filter(|time| *time > 0.0).map(Self::FrameTime)
            }
            _ => None,
        }
        .ok_or_else(error)
    }
}

impl fmt::Display for Budget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WrongPixels(percent) => write!(f, "wrong_pixels={percent}%"),
            Self::FrameTime(time) => write!(f, "frame_time={time}ms"),
        }
    }
}

/// The step and dial that a controller has chosen.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BudgetState {
    /// The step's number, from 0, the most accurate.
    pub step: usize,
    /// The dial's value in percent; 0 for a step without a dial.
    pub allow: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_says_its_unit_and_reads_as_it_prints() {
        for text in ["wrong_pixels=0.02%", "frame_time=16.6ms"] {
            assert_eq!(
                text.parse::<Budget>().map(|it| it.to_string()).as_deref(),
                Ok(text)
            );
        }
        assert_eq!("wrong_pixels=0".parse(), Ok(Budget::WrongPixels(0.0)));
        for text in [
            "wrong_pixels=0.02",
            "wrong_pixels=-1%",
            "wrong_pixels=101%",
            "wrong_pixels=NaN%",
            "frame_time=16",
            "frame_time=0ms",
            "speed=1%",
            "",
        ] {
            assert!(text.parse::<Budget>().is_err(), "{text}");
        }
    }
}
