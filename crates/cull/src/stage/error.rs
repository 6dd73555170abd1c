//! Why a stage fails.

use antumbra_graph::{CompileErrors, ExecuteError};
use antumbra_scene::CameraError;
use thiserror::Error;

use crate::device::DeviceError;
use crate::strategy::DeclareError;

/// Why a stage could not be built, or a frame not run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StageError {
    /// The strategy's settings, or the device.
    #[error(transparent)]
    Declare(#[from] DeclareError),
    /// The graph that the strategy declared does not compile.
    #[error("the graph of strategy '{strategy}' does not compile:\n{errors}")]
    Compile {
        /// The strategy.
        strategy: String,
        /// All that is wrong.
        errors: CompileErrors,
    },
    /// The strategy draws step by step in a loop, so that what it draws is never in one place.
    #[error(
        "strategy '{strategy}' draws step by step in a loop and has no answers alone: give it another latency, or ask for an image"
    )]
    NoAnswers {
        /// The strategy.
        strategy: String,
    },
    /// A frame failed.
    #[error(transparent)]
    Execute(#[from] ExecuteError),
    /// The device.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// An invalid camera.
    #[error("view '{view}': {error}")]
    Camera {
        /// The view.
        view: String,
        /// What is wrong with it.
        error: CameraError,
    },
    /// The caller's inputs do not fit the stage.
    #[error("the stage was given {0}")]
    Input(String),
}
