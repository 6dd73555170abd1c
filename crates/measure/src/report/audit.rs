//! The parts of a report about audits and budgets.

use serde::{Deserialize, Serialize};

/// A strategy's estimate of its own wrong pixels, over the poses at which they were measured as well.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct AuditReport {
    /// Frames, counted by view, whose audits have arrived.
    pub frames: u64,
    /// Inspected patches: mean over these frames.
    pub patches: f64,
    /// The estimate of the mean of the wrong pixels over these frames, in percent.
    pub percent: f64,
    /// The lower end of its interval of 95 %.
    pub low: f64,
    /// The upper end.
    pub high: f64,
    /// Of these frames, those whose own interval of 95 % contains the measured value.
    pub frames_within: u64,
    /// By pose: its own estimate, the mean of the views, in percent; 0 where the audit has not arrived.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wrong_pixels_percent: Vec<f64>,
}

/// A budget that a strategy had in place of settings.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct BudgetReport {
    /// The budget as it is written on a command line.
    pub asked: String,
    /// Whether the mean of the wrong pixels stayed within it; absent for a budget of time, for which see `frame_ms`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kept: Option<bool>,
    /// Whether they stayed within it as a share of the pixels that entities own; absent for a budget of time and in old reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kept_of_owned: Option<bool>,
    /// Frames on each step of the strategy's trade-off, the most accurate first.
    pub frames_a_step: Vec<u64>,
    /// Samples that frames were allowed to leave out by their own count, in percent of the pixels: mean over the frames.
    pub allowed_percent: f64,
}
