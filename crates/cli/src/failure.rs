//! Why the program ends without its work done, and the exit status that says which kind it was.

use std::path::PathBuf;

use antumbra::cull::{RegistryError, SettingError, StageError};
use antumbra::demo_scenes::DemoSceneError;
use antumbra::draw::{DeviceError, DrawError};
use antumbra::formats::{LoadError, RasterError, SaveError};
use antumbra::measure::MeasureError;
use antumbra::scene::StereoError;
use antumbra::subsurface::SubsurfaceError;
use antumbra::terrain::TerrainError;
use thiserror::Error;

/// What went wrong, for a person to read.
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
    /// A scene file.
    #[error("{}: {error}", path.display())]
    Load {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        error: LoadError,
    },
    /// A raster file.
    #[error(transparent)]
    Raster(#[from] RasterError),
    /// A scene could not be written.
    #[error(transparent)]
    Save(#[from] SaveError),
    /// Two eyes that cannot be.
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
}

impl From<SettingError> for Failure {
    fn from(error: SettingError) -> Self {
        Self::Registry(error.into())
    }
}

impl Failure {
    /// 2 for wrong usage, 1 for failed work.
    pub fn status(&self) -> u8 {
        match self {
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
