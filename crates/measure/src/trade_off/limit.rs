//! Error limits: the most error that is accepted.

use std::fmt;
use std::str::FromStr;

use crate::MeasureError;
use crate::report::{Aggregate, ErrorBasis, ErrorMeasure, ErrorReport, Report};

/// A limit of one kind of error.
///
/// Its text is `wrong_pixels=0.05%`, `wrong_of_owned=0.05%`, `false_culls=3` or `flip=0.01`. The first goes by [`Report::error_basis`]: by the share of the image or,
/// where entities own little of it, by that of the pixels that they own. A share of pixels needs its percent sign, since 0.05 could also mean one
/// pixel in twenty; only 0 needs none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorLimit {
    measure: ErrorMeasure,
    limit: f64,
}

/// The forms of a limit, for error messages.
const FORMS: &str = "write wrong_pixels=0.05% or wrong_of_owned=0.05% (0 to 100, with its %), false_culls=3, or flip=0.01 (0 to 1)";

impl ErrorLimit {
    /// At most `limit` of an error: percent of the pixels 0 to 100, entities, or FLIP 0 to 1.
    ///
    /// # Errors
    /// [`MeasureError::ErrorLimit`] for a limit that the measure cannot have.
    pub fn new(measure: ErrorMeasure, limit: f64) -> Result<Self, MeasureError> {
        let fits = match measure {
            ErrorMeasure::WrongPixelsPercent | ErrorMeasure::WrongOfOwnedPercent => {
                (0.0..=100.0).contains(&limit)
            }
            ErrorMeasure::FalseCulls => limit >= 0.0 && limit.is_finite() && limit.fract() == 0.0,
            ErrorMeasure::Flip => (0.0..=1.0).contains(&limit),
        };
        // -0 becomes 0.
        let limit = limit.abs();
        if fits {
            Ok(Self { measure, limit })
        } else {
            Err(refused(&Self { measure, limit }.to_string()))
        }
    }

    /// The limit as a report is held to it: wrong pixels by the share that the report goes by.
    pub(super) fn in_report(self, report: &Report) -> Self {
        let measure = match (self.measure, report.error_basis()) {
            (ErrorMeasure::WrongPixelsPercent, ErrorBasis::Owned) => {
                ErrorMeasure::WrongOfOwnedPercent
            }
            (measure, _) => measure,
        };
        Self { measure, ..self }
    }

    /// The error that is limited.
    pub fn measure(&self) -> ErrorMeasure {
        self.measure
    }

    /// The limit, in the measure's unit.
    pub fn limit(&self) -> f64 {
        self.limit
    }
}

impl ErrorMeasure {
    /// The aggregates that are compared with a limit.
    pub(super) fn aggregates(self) -> &'static [Aggregate] {
        match self {
            Self::WrongPixelsPercent | Self::WrongOfOwnedPercent | Self::Flip => {
                &[Aggregate::Mean, Aggregate::Max]
            }
            Self::FalseCulls => &[Aggregate::Sum],
        }
    }

    /// An aggregate of this measure in an error block; `None` for an aggregate that the measure does not have.
    pub(crate) fn of(self, error: &ErrorReport, over: Aggregate) -> Option<f64> {
        let number = match (self, over) {
            (Self::WrongPixelsPercent, Aggregate::Mean) => error.wrong_pixels_percent.mean,
            (Self::WrongPixelsPercent, Aggregate::Max) => error.wrong_pixels_percent.max,
            (Self::WrongOfOwnedPercent, Aggregate::Mean) => error.wrong_of_owned_percent?.mean,
            (Self::WrongOfOwnedPercent, Aggregate::Max) => error.wrong_of_owned_percent?.max,
            (Self::Flip, Aggregate::Mean) => error.flip.mean,
            (Self::Flip, Aggregate::Max) => error.flip.max,
            (Self::FalseCulls, Aggregate::Sum) => error.false_culls.entities as f64,
            _ => return None,
        };
        number.is_finite().then_some(number)
    }
}

impl FromStr for ErrorLimit {
    type Err = MeasureError;

    fn from_str(text: &str) -> Result<Self, MeasureError> {
        let parts = text.split_once('=');
        let (name, limit) = parts.ok_or_else(|| refused(text))?;
        let (measure, number) = match (name, limit.strip_suffix('%')) {
            ("wrong_pixels", Some(percent)) => (ErrorMeasure::WrongPixelsPercent, percent),
            ("wrong_of_owned", Some(percent)) => (ErrorMeasure::WrongOfOwnedPercent, percent),
            ("wrong_pixels", None) if limit.parse() == Ok(0.0) => {
                (ErrorMeasure::WrongPixelsPercent, limit)
            }
            ("wrong_of_owned", None) if limit.parse() == Ok(0.0) => {
                (ErrorMeasure::WrongOfOwnedPercent, limit)
            }
            ("false_culls", None) => (ErrorMeasure::FalseCulls, limit),
            ("flip", None) => (ErrorMeasure::Flip, limit),
            _ => return Err(refused(text)),
        };
        let limit = number.trim_end().parse().map_err(|_| refused(text))?;
        Self::new(measure, limit).map_err(|_| refused(text))
    }
}

impl fmt::Display for ErrorLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let limit = self.limit;
        match self.measure {
            ErrorMeasure::WrongPixelsPercent => write!(f, "wrong_pixels={limit}%"),
            ErrorMeasure::WrongOfOwnedPercent => write!(f, "wrong_of_owned={limit}%"),
            ErrorMeasure::FalseCulls => write!(f, "false_culls={limit}"),
            ErrorMeasure::Flip => write!(f, "flip={limit}"),
        }
    }
}

fn refused(text: &str) -> MeasureError {
    MeasureError::ErrorLimit {
        text: text.to_owned(),
        forms: FORMS,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn budgets_are_read_and_written_back() {
        for text in [
            "wrong_pixels=0.05%",
            "wrong_pixels=0%",
            "wrong_pixels=100%",
            "wrong_of_owned=0.5%",
            "false_culls=3",
            "flip=0.01",
            "flip=0",
        ] {
            let limit: ErrorLimit = text.parse().unwrap();
            assert_eq!(limit.to_string(), text);
        }
        for (text, same) in [
            ("wrong_pixels=0", "wrong_pixels=0%"),
            ("wrong_pixels=-0%", "wrong_pixels=0%"),
            ("wrong_pixels=5e-2 %", "wrong_pixels=0.05%"),
        ] {
            let limit: ErrorLimit = text.parse().unwrap();
            assert_eq!(limit.to_string(), same);
        }
    }

    #[test]
    fn what_could_be_misread_is_refused() {
        for text in [
            "wrong_pixels=0.05",
            "wrong_pixels=101%",
            "wrong_pixels=-1%",
            "wrong_pixels=%",
            "wrong_pixels=nan%",
            "wrong_of_owned=0.5",
            "wrong_pixels",
            "0.05%",
            "false_culls=0.5",
            "false_culls=inf",
            "false_culls=3%",
            "flip=2",
            "flip=NaN",
            "speed=3",
            "",
        ] {
            let error = text.parse::<ErrorLimit>().unwrap_err().to_string();
            assert!(
                error.contains(&format!("'{text}'")) && error.contains("wrong_pixels=0.05%"),
                "{error}"
            );
        }
    }
}
