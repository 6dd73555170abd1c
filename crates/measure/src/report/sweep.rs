//! The part of a report about a sweep: what was varied, which settings are on the efficient edge (the Pareto front), and which of them each
//! error limit selects.
//!
//! The functions of [`crate::trade_off`] make it from a report. The published fields call an error limit a budget.

use serde::{Deserialize, Serialize};

/// A sweep: strategies under all combinations of some of their settings, in one comparison. Every
/// strategy of the report that is no yardstick is one of its settings.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// The swept strategies as they were requested (`name` or `name:key=value`).
    pub strategies: Vec<String>,
    /// What was varied, in the order of the request.
    pub vary: Vec<VariedSetting>,
    /// The titles of the settings on the efficient edge, the most accurate first: see [`crate::trade_off::pareto_front`].
    pub edge: Vec<String>,
    /// What each error limit selects.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub budgets: Vec<LimitChoices>,
}

/// A setting and the values that were tried.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct VariedSetting {
    /// The strategy that has the setting; absent where the setting is varied for all swept strategies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub strategy: Option<String>,
    /// The setting.
    pub key: String,
    /// Its values as text that the setting parses.
    pub values: Vec<String>,
}

/// An error that can be limited. The names are those of the report's error block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorMeasure {
    /// Wrong pixels in percent of the pixels.
    WrongPixelsPercent,
    /// Wrong pixels in percent of the pixels that entities own.
    WrongOfOwnedPercent,
    /// False culls summed over all poses.
    FalseCulls,
    /// FLIP, 0 to 1.
    Flip,
}

/// The aggregate of a series that is compared with a limit.
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

/// An error limit and the settings that it selects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LimitChoices {
    /// The error that is limited.
    pub measure: ErrorMeasure,
    /// The most it may be, in the measure's unit.
    pub limit: f64,
    /// The choice for the mean and the one for the worst pose; for false culls, the one for their sum.
    pub choices: Vec<Choice>,
}

/// A selected setting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// The aggregate that is compared with the limit.
    pub over: Aggregate,
    /// The title of the setting.
    pub setting: String,
    /// Whether it stays within the limit. Where no setting does, the one with the least error is selected, and this is `false`.
    pub within: bool,
    /// Its error, in the measure's unit.
    pub error: f64,
    /// The limit minus its error: below 0 where it exceeds the limit.
    pub margin: f64,
    /// The title of the fastest setting within the limit, often the choice itself; absent where none is within.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fastest: Option<String>,
    /// The other settings within the limit whose speed does not differ significantly from the fastest one's. The choice has no more error
    /// than any of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub alike: Vec<String>,
    /// The fastest setting within the limit that is significantly slower than the fastest of all; absent where there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next: Option<RunnerUp>,
}

/// How significantly a setting is slower than the fastest within the limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunnerUp {
    /// The title of the setting.
    pub setting: String,
    /// Its time over that of the fastest: the median of the block ratios where both have series of frames.
    pub time_ratio: f64,
    /// Blocks in which it was slower; absent, like the two fields below, where there are no series.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slower_blocks: Option<u64>,
    /// Compared blocks; those of exactly equal time are left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub blocks: Option<u64>,
    /// The probability of at least so many slower blocks if both were equally fast (one-sided sign test).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by_chance: Option<f64>,
}
