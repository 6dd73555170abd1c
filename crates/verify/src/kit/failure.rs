//! What did not hold, in words that name the case, the frame, and the slots or pixels.

use std::fmt;

use antumbra_draw::{DeviceError, DrawError};
use antumbra_scene::{CameraError, SceneError};
use thiserror::Error;

use super::case::Case;
use antumbra_cull::StageError;

/// Why a strategy does not conform, or could not be checked.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum KitFailure {
    /// There is no device to check on.
    #[error("strategy '{strategy}' cannot be checked: {error}")]
    Device {
        /// The strategy with its settings.
        strategy: String,
        /// Why.
        error: DeviceError,
    },
    /// It does not conform.
    #[error(
        "strategy '{strategy}' does not conform on {adapter} (seed {seed}, {} x {} pixels):{}",
        size[0], size[1], list(violations)
    )]
    Violations {
        /// The strategy with its settings.
        strategy: String,
        /// The adapter, as `name (backend)`.
        adapter: String,
        /// The kit's seed, to run it again.
        seed: u64,
        /// Width and height of the views in pixels.
        size: [u32; 2],
        /// What did not hold: the first breach of each case that has one.
        violations: Vec<Violation>,
    },
}

impl KitFailure {
    /// The cases that did not hold; none where the device was what failed.
    pub fn cases(&self) -> Vec<Case> {
        match self {
            Self::Device { .. } => Vec::new(),
            Self::Violations { violations, .. } => {
                violations.iter().map(|violation| violation.case).collect()
            }
        }
    }
}

/// One thing that did not hold.
#[derive(Debug)]
pub struct Violation {
    /// In which case.
    pub case: Case,
    /// In which frame of it, from 0.
    pub frame: u32,
    /// What.
    pub kind: ViolationKind,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, frame {}: {}", self.case, self.frame, self.kind)
    }
}

/// What did not hold.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ViolationKind {
    /// A false cull of a strategy that claims to make none.
    #[error(
        "it claims to be conservative, yet slots {} own pixels and were not drawn; {pixels} pixels are wrong",
        some(slots)
    )]
    FalseCull {
        /// Slots that own a pixel and were not drawn.
        slots: Vec<u32>,
        /// Pixels whose owner changes by that.
        pixels: usize,
    },
    /// A false cull after late answers had time to settle.
    #[error(
        "nothing moved for {frames} frames, yet slots {} own pixels and were not drawn",
        some(slots)
    )]
    StillFalseCull {
        /// Frames since the last change.
        frames: u32,
        /// Slots that own a pixel and were not drawn.
        slots: Vec<u32>,
    },
    /// Something in plain sight was culled though no answer was about it.
    #[error(
        "slots {} own pixels and were culled by answers that do not cover them: first frame, cut, new in the slot, or new in the frustum",
        some(slots)
    )]
    CulledWithoutAnswer {
        /// The slots.
        slots: Vec<u32>,
    },
    /// Something was said to be visible before it could be known.
    #[error(
        "slots {} have the verdict 'visible' before any answer covers them: it should be 'new' or 'untested'",
        some(slots)
    )]
    VisibleWithoutAnswer {
        /// The slots.
        slots: Vec<u32>,
    },
    /// Something in plain sight that reaches over the near plane was culled.
    #[error(
        "slots {} own pixels, reach over the near plane, and were not drawn",
        some(slots)
    )]
    NearPlane {
        /// The slots.
        slots: Vec<u32>,
    },
    /// A verdict that contradicts the scene.
    #[error("slot {slot} has the verdict '{verdict}', yet {fact}")]
    Contradiction {
        /// The slot.
        slot: u32,
        /// The verdict's word.
        verdict: &'static str,
        /// What is the case.
        fact: &'static str,
    },
    /// The picture is not that of drawing everything.
    #[error(
        "it claims to be conservative, yet its picture differs from drawing everything in {pixels} pixels, first at {first:?}"
    )]
    WrongImage {
        /// How many pixels differ.
        pixels: usize,
        /// The first, from the upper left.
        first: [u32; 2],
    },
    /// The picture is not that of what the verdicts say.
    #[error(
        "its picture differs from drawing what its verdicts say in {pixels} pixels, first at {first:?}"
    )]
    FalseVerdicts {
        /// How many pixels differ.
        pixels: usize,
        /// The first, from the upper left.
        first: [u32; 2],
    },
    /// Verdicts that go on changing.
    #[error("nothing moved for {frames} frames, yet the verdicts still change")]
    Unsettled {
        /// Frames since the last change.
        frames: u32,
    },
    /// Two runs on the same input.
    #[error("two runs on the same input gave different verdicts")]
    NotRepeatable,
    /// A call failed.
    #[error("{0}")]
    Failed(String),
    /// Something panicked.
    #[error("it panicked: {0}")]
    Panicked(String),
}

macro_rules! failed {
    ($($error:ty),*) => {$(
        impl From<$error> for ViolationKind {
            fn from(error: $error) -> Self {
                Self::Failed(error.to_string())
            }
        }
    )*};
}

failed!(SceneError, CameraError, DrawError, DeviceError, StageError);

/// The first few of many.
fn some(slots: &[u32]) -> String {
    let shown: Vec<String> = slots.iter().take(8).map(u32::to_string).collect();
    let rest = slots.len().saturating_sub(8);
    let more = if rest > 0 {
        format!(" and {rest} more")
    } else {
        String::new()
    };
    shown.join(", ") + &more
}

fn list(violations: &[Violation]) -> String {
    violations
        .iter()
        .map(|violation| format!("\n  - {violation}"))
        .collect()
}
