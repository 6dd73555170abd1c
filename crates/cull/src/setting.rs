//! Settings by name: what a command line, a sweep or a report needs of a strategy's knobs.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// One knob of a strategy as it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setting {
    /// Its name, as in `--set strategy.key=value`.
    pub key: &'static str,
    /// Its present value, as text that would set it again.
    pub value: String,
    /// What values it takes.
    pub range: &'static str,
    /// What it does, in a sentence.
    pub meaning: &'static str,
}

/// Why a setting was refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SettingError {
    /// There is no such knob.
    #[error("strategy '{strategy}' has no setting '{key}' (it has: {})", if known.is_empty() { "none".to_owned() } else { known.join(", ") })]
    Unknown {
        /// The strategy.
        strategy: String,
        /// What was asked for.
        key: String,
        /// The knobs there are.
        known: Vec<&'static str>,
    },
    /// A setting that names another strategy, and there is none of that name.
    #[error("'{name}' is no strategy for the setting '{key}' (there are: {})", known.join(", "))]
    Strategy {
        /// The knob.
        key: String,
        /// What was asked for.
        name: String,
        /// Those there are.
        known: Vec<String>,
    },
    /// The value is outside its range, or not of its kind.
    #[error("'{value}' is no value for the setting '{key}': it takes {range}")]
    Value {
        /// The knob.
        key: String,
        /// The value.
        value: String,
        /// What it takes.
        range: &'static str,
    },
}

/// Reads a value, or says what the setting takes.
///
/// # Errors
/// [`SettingError::Value`] when the text is not of the kind, or `allowed` refuses it.
pub fn parse<T: FromStr>(
    key: &str,
    value: &str,
    range: &'static str,
    allowed: impl Fn(&T) -> bool,
) -> Result<T, SettingError> {
    let refused = || SettingError::Value {
        key: key.to_owned(),
        value: value.to_owned(),
        range,
    };
    value.parse().ok().filter(allowed).ok_or_else(refused)
}

/// When a query's answer is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Latency {
    /// A frame later: no stall, and the answer one frame old.
    #[default]
    FrameLate,
    /// In the same frame, by a sync point.
    SameFrame,
    /// In the same frame on the GPU: indirect draws, neither stall nor delay.
    OnGpu,
}

impl fmt::Display for Latency {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::FrameLate => "frame-late",
            Self::SameFrame => "same-frame",
            Self::OnGpu => "on-gpu",
        })
    }
}

impl FromStr for Latency {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        match text {
            "frame-late" => Ok(Self::FrameLate),
            "same-frame" => Ok(Self::SameFrame),
            "on-gpu" => Ok(Self::OnGpu),
            _ => Err(()),
        }
    }
}

/// What a `latency` setting takes.
pub const LATENCY_RANGE: &str = "frame-late, same-frame or on-gpu";
