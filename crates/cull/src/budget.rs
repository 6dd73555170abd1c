//! A budget in place of settings: how much of the image may be wrong, or how long a frame may take. A controller turns the strategy's knobs by
//! what the audit finds, frame by frame.
//!
//! A strategy says how it trades: [`Step`](crate::Step)s from the most accurate to the fastest, of which some have a dial that says how much a frame may leave out
//! ([`Tunable::steps`](crate::Tunable::steps)). `docs/accuracy.md` tells how well that keeps.

mod belief;
mod error;
mod keeping;
mod time;

use std::fmt;
use std::str::FromStr;

pub(crate) use keeping::Keeping;
use thiserror::Error;

/// What a user sets in place of settings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Budget {
    /// The mean of the wrong pixels over frames, in percent of a view's pixels: as fast as that allows. 0: conservative settings.
    WrongPixels(f64),
    /// Milliseconds of a frame: as accurate as that allows.
    FrameTime(f64),
}

/// Why a text is no budget.
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
            // A bare 0 is 0 in any unit.
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

/// Where a controller stands.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BudgetState {
    /// Which step, counted from the most accurate.
    pub step: usize,
    /// Where its dial stands, in percent; 0 where it has none.
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
