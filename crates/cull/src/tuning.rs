//! What can be tuned about a strategy: typed settings by name, and the steps of its trade between accuracy and speed.
//!
//! A strategy describes each of its settings once, in a table of [`Parameter`]s: its name, range, unit and meaning, and how it is read and
//! written. Command lines, sweeps, reports, budgets and sliders all go by that table. A strategy without settings needs nothing of this file.
//!
//! ```
//! use antumbra_cull::{Parameter, Setting, SettingError, Step, Tunable, Value, assign, describe};
//!
//! struct Nearby { reach: f64, transparent: bool }
//!
//! const PARAMETERS: &[Parameter<Nearby>] = &[
//!     Parameter::number("reach", 0.0..=1e6, "m", "entities nearer than this are drawn", |s| s.reach, |s, reach| s.reach = reach),
//!     Parameter::switch("transparent", "whether blended entities are drawn", |s| s.transparent, |s, on| s.transparent = on),
//! ];
//!
//! impl Tunable for Nearby {
//!     fn settings(&self) -> Vec<Setting> { describe(PARAMETERS, self) }
//!     fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> { assign("nearby", PARAMETERS, self, key, value) }
//! }
//!
//! let mut nearby = Nearby { reach: 10.0, transparent: false };
//! nearby.set("reach", &Value::Number(25.0))?;
//! nearby.set_text("transparent", "true")?;
//! assert_eq!(nearby.settings()[0].range.to_string(), "a number from 0 to 1000000");
//! # Ok::<(), SettingError>(())
//! ```

mod parameter;
mod setting_range;
mod step;
mod value;

pub use parameter::{Parameter, assign, describe, shortest};
pub use setting_range::SettingRange;
pub use step::Step;
pub use value::Value;

use thiserror::Error;

/// A strategy's settings by name.
pub trait Tunable {
    /// All settings with their present values, in the order to show them in.
    fn settings(&self) -> Vec<Setting>;

    /// Sets one.
    ///
    /// # Errors
    /// [`SettingError`] for a name that no setting has, a value out of range, or a strategy's name that is unknown.
    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError>;

    /// The settings whose value is a word that means "as the image's size has it", each with the value that it has for views of so many pixels (width, height).
    fn following(&self, size: [u32; 2]) -> Vec<(&'static str, Value)> {
        let _ = size;
        Vec::new()
    }

    /// How the strategy trades accuracy for speed when it is given a [`Budget`](crate::Budget): its steps from the most accurate, which is
    /// conservative, to the fastest. Empty: it has nothing to trade.
    fn steps(&self) -> Vec<Step> {
        Vec::new()
    }

    /// Sets one from text.
    ///
    /// # Errors
    /// As [`Self::set`], and [`SettingError::Value`] for text that is no value of its kind.
    fn set_text(&mut self, key: &str, text: &str) -> Result<(), SettingError> {
        let setting = self
            .settings()
            .into_iter()
            .find(|setting| setting.key == key);
        let value = match &setting {
            Some(setting) => setting
                .range
                .read(text)
                .ok_or_else(|| setting.refuse(text))?,
            // Its owner says what there is instead.
            None => Value::from(text.to_owned()),
        };
        self.set(key, &value)
    }
}

/// One setting as it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Its name, as in `--set strategy.key=value`.
    pub key: &'static str,
    /// Its present value.
    pub value: Value,
    /// What values it takes.
    pub range: SettingRange,
    /// The unit of its number: `px`, `%`, `frames`; empty for a bare number and for words. Shown beside the value.
    pub unit: &'static str,
    /// What it does, in a sentence.
    pub meaning: &'static str,
}

impl Setting {
    /// The error for a value that it does not take.
    pub fn refuse(&self, value: impl ToString) -> SettingError {
        SettingError::Value {
            key: self.key.to_owned(),
            value: value.to_string(),
            range: self.range.to_string(),
        }
    }
}

/// Why a setting was refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SettingError {
    /// The strategy has no such setting.
    #[error("strategy '{strategy}' has no setting '{key}' (it has: {})", if known.is_empty() { "none".to_owned() } else { known.join(", ") })]
    Unknown {
        /// The strategy.
        strategy: String,
        /// The name that was given.
        key: String,
        /// The settings there are.
        known: Vec<&'static str>,
    },
    /// A setting that names another strategy, and there is none of that name.
    #[error("'{name}' is no strategy for the setting '{key}' (there are: {})", known.join(", "))]
    Strategy {
        /// The setting.
        key: String,
        /// The name that was given.
        name: String,
        /// The strategies there are.
        known: Vec<String>,
    },
    /// The value is outside its range, or not of its kind.
    #[error("'{value}' is no value for the setting '{key}': it takes {range}")]
    Value {
        /// The setting.
        key: String,
        /// The value.
        value: String,
        /// What it takes.
        range: String,
    },
}
