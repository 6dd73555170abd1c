//! What a strategy's audit said of its own wrong pixels, and what a budget was kept with.

use serde::{Deserialize, Serialize};

/// An audit, over the poses at which the truth is known as well.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct AuditReport {
    /// Frames of views whose audits have come.
    pub frames: u64,
    /// Patches looked at, mean a frame of a view.
    pub patches: f64,
    /// The estimate of the mean of the wrong pixels over these frames, in percent.
    pub percent: f64,
    /// Its interval of 95 %: from here,
    pub low: f64,
    /// to here.
    pub high: f64,
    /// Frames of views whose own interval of 95 % holds what was really wrong.
    pub frames_within: u64,
    /// The estimate of each pose by itself, mean of the views, in percent; poses whose audit has not come are 0.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wrong_pixels_percent: Vec<f64>,
}

/// A budget that was to be kept in place of settings.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct BudgetReport {
    /// The budget as it is written on a command line.
    pub asked: String,
    /// Whether the mean of the wrong pixels stayed within it; absent for a budget of time, which `frame_ms` tells of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kept: Option<bool>,
    /// Frames on each step of the strategy's trade, the most accurate first.
    pub frames_a_step: Vec<u64>,
    /// What frames were allowed to leave out by their own count, mean a frame, in percent.
    pub allowed_percent: f64,
}
