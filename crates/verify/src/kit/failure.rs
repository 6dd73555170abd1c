//! What the kit reports: violations that name the case, the frame, and the slots or pixels.

use std::fmt;

use antumbra_cull::{DeviceError, StageError};
use antumbra_draw::DrawError;
use antumbra_scene::{CameraError, SceneError};
use thiserror::Error;

use super::case::Case;
use super::setup::Setup;

/// Why a strategy does not conform, or could not be checked.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum KitFailure {
    /// There is no device to check on.
    #[error("strategy '{strategy}' cannot be checked: {error}")]
    Device {
        /// The strategy with its settings.
        strategy: String,
        /// Why there is none.
        error: DeviceError,
    },
    /// The strategy does not conform.
    #[error(
        "strategy '{strategy}' does not conform on {adapter} (seed {seed}, {} x {} pixels):{}",
        size[0], size[1], list(violations)
    )]
    Violations {
        /// The strategy with its settings.
        strategy: String,
        /// The adapter, as `name (backend)`.
        adapter: String,
        /// The kit's seed, to repeat the run.
        seed: u64,
        /// Width and height of the views in pixels.
        size: [u32; 2],
        /// The first violation of each case that has one.
        violations: Vec<Violation>,
    },
}

impl KitFailure {
    /// The cases with a violation; empty if there was no device.
    pub fn cases(&self) -> Vec<Case> {
        match self {
            Self::Device { .. } => Vec::new(),
            Self::Violations { violations, .. } => {
                violations.iter().map(|violation| violation.case).collect()
            }
        }
    }
}

/// A violation, and where it was found.
#[derive(Debug)]
pub struct Violation {
    /// The case.
    pub case: Case,
    /// How the stage was run.
    pub setup: Setup,
    /// The frame within the scene that the case was playing, from 0.
    pub frame: u32,
    /// What is wrong.
    pub kind: ViolationKind,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            case,
            setup,
            frame,
            kind,
        } = self;
        match *setup == Setup::PLAIN {
            true => write!(f, "{case}, frame {frame}: {kind}"),
            false => write!(f, "{case} ({setup}), frame {frame}: {kind}"),
        }
    }
}

/// The ways in which a strategy can violate what the kit requires.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ViolationKind {
    /// A strategy that claims to be conservative culled a visible entity.
    #[error(
        "it claims to be conservative but does not draw slots {}, which own samples; {pixels} pixels are wrong",
        first_few(slots)
    )]
    FalseCull {
        /// Slots that own a sample and were not drawn.
        slots: Vec<u32>,
        /// Number of pixels whose owner is therefore wrong.
        pixels: usize,
    },
    /// A visible entity is still culled after late answers had time to settle.
    #[error(
        "after {frames} frames without a change it does not draw slots {}, which own samples",
        first_few(slots)
    )]
    StillFalseCull {
        /// Number of frames since the last change.
        frames: u32,
        /// Slots that own a sample and were not drawn.
        slots: Vec<u32>,
    },
    /// A visible entity was culled although no answer covers it.
    #[error(
        "it does not draw slots {}, which own samples and which no answer covers: first frame, cut, new in the slot, or new in the frustum",
        first_few(slots)
    )]
    CulledWithoutAnswer {
        /// The slots.
        slots: Vec<u32>,
    },
    /// An entity has the verdict *visible* although no answer covers it.
    #[error(
        "slots {} have the verdict 'visible' before any answer covers them: it should be 'new' or 'untested'",
        first_few(slots)
    )]
    VisibleWithoutAnswer {
        /// The slots.
        slots: Vec<u32>,
    },
    /// A visible entity that crosses the near plane was culled.
    #[error(
        "it does not draw slots {}, which own samples and cross the near plane",
        first_few(slots)
    )]
    NearPlane {
        /// The slots.
        slots: Vec<u32>,
    },
    /// A verdict contradicts the scene.
    #[error("slot {slot} has the verdict '{verdict}', but {fact}")]
    Contradiction {
        /// The slot.
        slot: u32,
        /// The verdict's word.
        verdict: &'static str,
        /// What is true instead.
        fact: &'static str,
    },
    /// The image of a strategy that claims to be conservative is not that of drawing everything.
    #[error(
        "it claims to be conservative, but its image differs from drawing everything in {pixels} pixels, first at {first:?}"
    )]
    WrongImage {
        /// Number of pixels that differ.
        pixels: usize,
        /// Column and row of the first of them, from the upper left.
        first: [u32; 2],
    },
    /// The image is not that of drawing what the verdicts say.
    #[error(
        "its image differs from drawing what its verdicts say in {pixels} pixels, first at {first:?}"
    )]
    FalseVerdicts {
        /// Number of pixels that differ.
        pixels: usize,
        /// Column and row of the first of them, from the upper left.
        first: [u32; 2],
    },
    /// What its answers draw is not what the verdicts say.
    #[error(
        "its answers and its verdicts disagree about slots {}",
        first_few(slots)
    )]
    FalseAnswers {
        /// Slots that one of the two draws and the other does not.
        slots: Vec<u32>,
    },
    /// The verdicts do not settle.
    #[error("after {frames} frames without a change the verdicts still change")]
    Unsettled {
        /// Number of frames since the last change.
        frames: u32,
    },
    /// The verdicts do not follow from the input.
    #[error("two runs on the same input gave different verdicts")]
    NotRepeatable,
    /// A call failed.
    #[error("{0}")]
    Failed(String),
    /// The strategy, or what it called, panicked.
    #[error("it panicked: {0}")]
    Panicked(String),
}

/// Errors of calls become [`ViolationKind::Failed`].
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

/// The first eight slots, and the number of the others.
fn first_few(slots: &[u32]) -> String {
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
