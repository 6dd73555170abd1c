//! Why the program ends before its work is done, and the exit status for it.

use std::path::PathBuf;

use antumbra::cull::{DeviceError, RegistryError, SettingError, StageError};
use antumbra::demo_scenes::DemoSceneError;
use antumbra::draw::DrawError;
use antumbra::formats::{LoadError, RasterError, SaveError};
use antumbra::measure::MeasureError;
use antumbra::scene::StereoError;
use antumbra::scene::animation::AnimationError;
use antumbra::subsurface::SubsurfaceError;
use antumbra::terrain::TerrainError;
use thiserror::Error;

use crate::interrupt::Interruption;

/// What went wrong, in words for the user.
#[derive(Debug, Error)]
pub enum Failure {
    /// The command line asks for something that does not exist.
    #[error("{0}")]
    Usage(String),
    /// No such strategy or setting.
    #[error(transparent)]
    Registry(#[from] RegistryError),
    /// No such built-in scene.
    #[error(transparent)]
    Builtin(#[from] DemoSceneError),
    /// A sub-surface model.
    #[error(transparent)]
    Subsurface(#[from] SubsurfaceError),
    /// A terrain.
    #[error(transparent)]
    Terrain(#[from] TerrainError),
    /// A scene file. The message names it.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// A file whose surface is no terrain.
    #[error("{}: {error}", file.display())]
    Field {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        error: Box<TerrainError>,
    },
    /// A raster file.
    #[error(transparent)]
    Raster(#[from] RasterError),
    /// A scene could not be written.
    #[error(transparent)]
    Save(#[from] SaveError),
    /// An animation's pose.
    #[error(transparent)]
    Animation(#[from] AnimationError),
    /// Two eyes at impossible distances.
    #[error(transparent)]
    Stereo(#[from] StereoError),
    /// The device.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The scene does not fit the device.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// A stage could not be built or run.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// The measuring, or a path or report file.
    #[error(transparent)]
    Measure(#[from] MeasureError),
    /// An output that cannot be written.
    #[error("cannot write '{}': {error}", path.display())]
    Output {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// A signal asked the program to end.
    #[error("{0}")]
    Interrupted(Interruption),
    /// Drivers whose answers are wrong.
    #[error(
        "the self-test found wrong answers on {}. A stage there counts in another way or draws all that is in the frustum; another version of the driver may be right",
        .0.join(", ")
    )]
    SelfTest(Vec<String>),
    /// Standard output cannot be written.
    #[error("cannot write to standard output: {0}")]
    Print(std::io::Error),
    /// The reader of standard output has closed its end.
    #[error("the reader of standard output is gone")]
    ClosedPipe,
}

impl From<SettingError> for Failure {
    fn from(error: SettingError) -> Self {
        Self::Registry(error.into())
    }
}

impl Failure {
    /// Whether it ends the program without a message.
    pub fn is_silent(&self) -> bool {
        matches!(self, Self::ClosedPipe)
    }

    /// The exit status: 2 for wrong usage, 1 for failed work, 0 for a reader that has read enough, 128 and the signal's number for a signal.
    pub fn status(&self) -> u8 {
        match self {
            Self::Interrupted(interruption) => interruption.status(),
            Self::ClosedPipe => 0,
            Self::Usage(_)
            | Self::Registry(_)
            | Self::Builtin(_)
            | Self::Stereo(_)
            | Self::Subsurface(SubsurfaceError::Setting { .. })
            | Self::Stage(StageError::Declare(_)) => 2,
            _ => 1,
        }
    }
}
