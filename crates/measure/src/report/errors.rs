//! The parts of a report about errors: wrong pixels as two shares, false culls, ties, and entities that are lost for good.

use serde::{Deserialize, Serialize};

use super::{MeanMax, Report};

/// Differences from the reference.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorReport {
    /// Wrong pixels in percent of the view.
    pub wrong_pixels_percent: MeanMax,
    /// Wrong pixels in percent of the pixels that entities own: over all poses together, and in the worst pose; absent in old reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrong_of_owned_percent: Option<MeanMax>,
    /// False culls.
    pub false_culls: FalseCulls,
    /// Ties, which are no errors; absent in old reports, which count some of them as wrong pixels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ties: Option<Ties>,
    /// The FLIP difference of the shaded images, 0 (equal) to 1.
    pub flip: MeanMax,
}

/// Entities that own pixels of the reference and were not drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FalseCulls {
    /// False culls summed over all poses: an entity that is missing in three frames counts three times.
    pub entities: u64,
    /// The pose with the most false culls; absent when there are none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst_frame: Option<u64>,
    /// The longest run of consecutive frames with a false cull in each.
    pub longest_run_frames: u64,
}

/// Pixels that show another entity of equal depth than the reference does.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Ties {
    /// Pixels whose owner was not drawn, and which show another entity at the same depth: percent of the view.
    pub culled_percent: MeanMax,
    /// Entities that were not drawn and lost nothing but such pixels, summed over all poses.
    pub culled_entities: u64,
    /// Pixels of the shaded image whose colour differs from the reference although their owner was drawn: percent of the view, at the poses at which FLIP is
    /// computed.
    pub shown_percent: MeanMax,
}

impl Ties {
    /// Both kinds, in percent of the view, each the mean of the poses at which it is measured: all for the first, and those of FLIP for the second.
    pub fn percent(&self) -> f64 {
        self.culled_percent.mean + self.shown_percent.mean
    }
}

/// Entities that own a pixel of the reference in at least one pose, and lost it in each pose in which they do.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LostEntities {
    /// Their number.
    pub entities: u64,
    /// The number of entities that own a pixel in at least one pose.
    pub of: u64,
    /// Some of them, those with the most pixels first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub named: Vec<String>,
}

/// What a share of wrong pixels is a share of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorBasis {
    /// All pixels of the image.
    Image,
    /// The pixels that entities own in the reference.
    Owned,
}

/// Below this share of the pixels, in percent, the background hides what is lost: a share of the image is less than half of the share of what is seen.
const COVERED_PERCENT: f64 = 50.0;

impl Report {
    /// What recommendations, the efficient edge, choices and plots go by: wrong pixels as a share of the image or, where entities own less than half of the
    /// pixels, of the pixels that they own. Old reports have only the first.
    pub fn error_basis(&self) -> ErrorBasis {
        let covers_little = self
            .scene
            .owned_percent
            .is_some_and(|percent| percent < COVERED_PERCENT);
        let measured = |error: &ErrorReport| error.wrong_of_owned_percent.is_some();
        match covers_little && self.strategies.iter().all(|one| measured(&one.error)) {
            true => ErrorBasis::Owned,
            false => ErrorBasis::Image,
        }
    }
}

impl ErrorBasis {
    /// "of the image" or "of the pixels that entities own".
    pub fn words(self) -> &'static str {
        match self {
            Self::Image => "of the image",
            Self::Owned => "of the pixels that entities own",
        }
    }
}

impl ErrorReport {
    /// The wrong pixels as a share of this; of the image where the other was not measured.
    pub fn wrong(&self, basis: ErrorBasis) -> MeanMax {
        match (basis, self.wrong_of_owned_percent) {
            (ErrorBasis::Owned, Some(owned)) => owned,
            _ => self.wrong_pixels_percent,
        }
    }

    /// Whether any entity was culled that has the depth of what is drawn in its place.
    pub fn culls_ties(&self) -> bool {
        self.ties
            .is_some_and(|ties| ties.culled_entities > 0 || ties.culled_percent.max > 0.0)
    }
}
