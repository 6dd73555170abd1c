//! What a report says of the scene, the path and the views.

use antumbra_scene::Stereo;
use serde::{Deserialize, Serialize};

use super::MotionFacts;

/// The scene, the path and the views of a comparison.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneFacts {
    /// The name of the built-in scene or of the file.
    pub name: String,
    /// The camera path: `orbit`, `flight` or the path's file.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub path: String,
    /// Drawable entities.
    pub entities: u64,
    /// Triangles of all drawable entities at full detail.
    pub triangles: u64,
    /// Views of a frame: 1, or 2 for stereo.
    pub views: u32,
    /// The two eyes of stereo; absent for one view.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stereo: Option<StereoFacts>,
    /// Width and height of one view in pixels.
    pub size: [u32; 2],
    /// Samples a pixel.
    #[serde(default = "one_sample")]
    pub samples: u32,
    /// Frames in flight: late answers are so many frames old when they are used. Absent in old reports, where it was 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub in_flight: Option<u32>,
    /// Poses of the path; each is one frame.
    pub frames: u64,
    /// Pixels of the reference that entities own, in percent of the pixels of all poses and views; absent in old reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub owned_percent: Option<f64>,
    /// The animation that plays; absent for a scene that stands still.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionFacts>,
    /// What the scene lacks of its file; empty where nothing was left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<MissingParts>,
}

/// Parts of a scene's file that were left out for one reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct MissingParts {
    /// Their kind, in the plural but for exactly one: `image`, `animations`, ...
    pub part: String,
    /// Their number.
    pub count: u64,
    /// Why.
    pub reason: String,
}

/// Older reports do not say: they are of one sample a pixel.
fn one_sample() -> u32 {
    1
}

/// Two parallel eyes whose image windows coincide at a distance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StereoFacts {
    /// Metres between the eyes.
    pub interocular: f64,
    /// Distance in metres at which the windows coincide.
    pub convergence: f64,
}

impl From<Stereo> for StereoFacts {
    fn from(stereo: Stereo) -> Self {
        Self {
            interocular: stereo.interocular,
            convergence: stereo.convergence,
        }
    }
}
