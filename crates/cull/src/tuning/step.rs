//! One step of a strategy's trade between accuracy and speed.

use super::value::Value;

/// One step of a strategy's trade between accuracy and speed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Step {
    /// What is set, by name; all other settings stay as they are.
    pub settings: Vec<(&'static str, Value)>,
    /// A setting in percent of the image, 0 to 100, that may change between frames without a new plan: what a frame may leave out by its own count.
    pub dial: Option<&'static str>,
}

impl Step {
    /// A step of these settings, without a dial.
    pub fn of(settings: impl IntoIterator<Item = (&'static str, Value)>) -> Self {
        Self {
            settings: settings.into_iter().collect(),
            dial: None,
        }
    }

    /// The same with more settings; of two of one name the later one counts.
    #[must_use]
    pub fn and(mut self, settings: impl IntoIterator<Item = (&'static str, Value)>) -> Self {
        self.settings.extend(settings);
        self
    }

    /// The same with a dial.
    #[must_use]
    pub fn with_dial(mut self, key: &'static str) -> Self {
        self.dial = Some(key);
        self
    }
}
