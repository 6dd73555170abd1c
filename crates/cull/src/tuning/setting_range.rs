//! What values a setting takes.

use std::fmt;
use std::ops::{Bound, RangeBounds, RangeInclusive};

use super::value::Value;

/// The word for a number that a strategy finds by itself.
pub(super) const AUTO: &str = "auto";

/// What values a setting takes: what a slider, a switch or a list is made from. Prints as words for a message.
#[derive(Debug, Clone, PartialEq)]
pub enum SettingRange {
    /// A whole number.
    Whole(RangeInclusive<u32>),
    /// A whole number, or `auto`: the strategy finds one by itself.
    WholeOrAuto(RangeInclusive<u32>),
    /// A number. Without an upper bound it may be infinite, which is written `any`.
    Number(Bound<f64>, Bound<f64>),
    /// `true` or `false`.
    Switch,
    /// One of these words.
    Words(&'static [&'static str]),
    /// The name of another strategy, whose settings follow.
    Strategy,
}

impl SettingRange {
    /// Whether a value is one of them. What names a strategy is known to its registry alone.
    pub fn takes(&self, value: &Value) -> bool {
        match (self, value) {
            (Self::Whole(range) | Self::WholeOrAuto(range), Value::Number(number)) => {
                let whole = number.fract() == 0.0;
                whole && (f64::from(*range.start())..=f64::from(*range.end())).contains(number)
            }
            (Self::Number(least, most), Value::Number(number)) => {
                (*least, *most).contains(number)
                    && (number.is_finite() || *most == Bound::Unbounded)
            }
            (Self::Switch, Value::Switch(_)) | (Self::Strategy, Value::Word(_)) => true,
            (Self::WholeOrAuto(_), Value::Word(word)) => word == AUTO,
            (Self::Words(words), Value::Word(word)) => words.contains(&word.as_ref()),
            _ => false,
        }
    }

    /// Reads one of them; `None` for text that is none.
    pub fn read(&self, text: &str) -> Option<Value> {
        let value = match self {
            // Digits alone: 1e3 and 5.0 are no whole numbers.
            Self::WholeOrAuto(_) if text == AUTO => Value::from(AUTO),
            Self::Whole(_) | Self::WholeOrAuto(_) => Value::from(text.parse::<u32>().ok()?),
            Self::Number(_, Bound::Unbounded) if text == "any" => Value::Number(f64::INFINITY),
            Self::Number(..) => Value::Number(text.parse().ok().filter(|it: &f64| it.is_finite())?),
            Self::Switch => Value::Switch(text.parse().ok()?),
            Self::Words(_) | Self::Strategy => Value::from(text.to_owned()),
        };
        self.takes(&value).then_some(value)
    }
}

impl fmt::Display for SettingRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole(range) => write!(f, "a whole number, {} to {}", range.start(), range.end()),
            Self::WholeOrAuto(range) => write!(
                f,
                "a whole number, {} to {}, or {AUTO}",
                range.start(),
                range.end()
            ),
            Self::Number(least, most) => {
                f.write_str("a number")?;
                match (least, most) {
                    (Bound::Included(least), Bound::Included(most)) => {
                        return write!(f, " from {least} to {most}");
                    }
                    (Bound::Included(least), _) => write!(f, " from {least}")?,
                    (Bound::Excluded(least), _) => write!(f, " above {least}")?,
                    (Bound::Unbounded, _) => {}
                }
                match most {
                    Bound::Included(most) => write!(f, ", at most {most}"),
                    Bound::Excluded(most) => write!(f, ", below {most}"),
                    Bound::Unbounded => f.write_str(", or any"),
                }
            }
            Self::Switch => f.write_str("true or false"),
            Self::Words([]) => f.write_str("nothing"),
            Self::Words([one]) => f.write_str(one),
            Self::Words([before @ .., last]) => write!(f, "{} or {last}", before.join(", ")),
            Self::Strategy => f.write_str("the name of another strategy, whose settings follow"),
        }
    }
}
