//! What plays while a scene is measured.

use serde::{Deserialize, Serialize};

/// An animation of the scene's file, and the times at which poses show it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MotionFacts {
    /// Its number among those of the scene that can be played, from 0.
    pub clip: u64,
    /// Its name; empty where it has none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Seconds until it begins again.
    pub seconds: f64,
    /// Seconds at the first pose.
    pub start: f64,
    /// How many poses a second of it has; absent where all poses show the same time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames_per_second: Option<f64>,
}
