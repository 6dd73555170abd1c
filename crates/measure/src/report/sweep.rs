//! What a sweep adds to a report: what was varied, which settings lie on the efficient edge, and
//! which of them a budget of errors chooses.
//!
//! The functions of [`crate::trade_off`] make these out of what was measured.

use serde::{Deserialize, Serialize};

/// A sweep: strategies under all combinations of some of their settings, in one comparison. Every
/// strategy of the report that is no yardstick is one of its settings.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// The strategies that were swept, as they were asked for (`name` or `name:key=value`).
    pub strategies: Vec<String>,
    /// What was varied, in the order asked for.
    pub vary: Vec<VariedSetting>,
    /// The titles of the settings on the efficient edge, the most right first: see
    /// [`crate::trade_off::edge`].
    pub edge: Vec<String>,
    /// What the budgets that were given choose.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub budgets: Vec<LimitChoices>,
}

/// A setting and the values that were tried.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct VariedSetting {
    /// The one strategy whose setting it is; absent where it is one of all that were swept.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub strategy: Option<String>,
    /// The setting.
    pub key: String,
    /// Its values, as text that would set them again.
    pub values: Vec<String>,
}

/// An error that a budget can limit. The names are those of the report's error block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorMeasure {
    /// Wrong pixels in percent of the pixels.
    WrongPixelsPercent,
    /// False culls summed over all poses.
    FalseCulls,
    /// FLIP, 0 to 1.
    Flip,
}

/// Which of a series' numbers a limit is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aggregate {
    /// The mean over all poses.
    Mean,
    /// The worst pose.
    Max,
    /// The sum over all poses.
    Sum,
}

/// A budget and what it chooses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LimitChoices {
    /// The error that is limited.
    pub measure: ErrorMeasure,
    /// The most it may be, in the measure's unit.
    pub limit: f64,
    /// The choice for the mean and the one for the worst pose; for false culls, the one for their
    /// sum.
    pub choices: Vec<Choice>,
}

/// The setting to take.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// What is held against the limit.
    pub over: Aggregate,
    /// The title of the setting.
    pub setting: String,
    /// Whether it stays within the budget. Where no setting does, the one with the least error is
    /// named, and this is `false`.
    pub within: bool,
    /// Its error, in the measure's unit.
    pub error: f64,
    /// The limit less its error: below 0 where it does not stay within.
    pub margin: f64,
    /// The title of the fastest setting within the budget, which is mostly the choice itself; absent
    /// where none is within.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fastest: Option<String>,
    /// The other settings within the budget whose speed the noise does not tell apart from the
    /// fastest one's: the choice has no more error than any of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub alike: Vec<String>,
    /// The fastest setting within the budget that is slower than the fastest of all beyond the noise;
    /// absent where none is left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next: Option<RunnerUp>,
}

/// How certain it is that a setting is slower than the fastest within the budget.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunnerUp {
    /// The title of the setting.
    pub setting: String,
    /// Its time over the fastest's: the median of the block ratios where both have series of frames.
    pub time_ratio: f64,
    /// In how many blocks it was slower; absent with the two that follow where there are no series.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slower_blocks: Option<u64>,
    /// Blocks that were compared, those of exactly equal time left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub blocks: Option<u64>,
    /// How probable so many slower blocks would be if both were equally fast (sign test, one-sided).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by_chance: Option<f64>,
}
