//! What can go wrong with a sub-surface model: what, where, and what to do.

use std::path::PathBuf;

use antumbra_scene::SceneError;
use thiserror::Error;

/// Why a sub-surface model could not be read, prepared or shown.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SubsurfaceError {
    /// A file cannot be opened, read, made or written.
    #[error("cannot {action} {}: {source}", path.display())]
    File {
        /// `open`, `read`, `create`, `write`.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file is not what it should be.
    #[error("{} is no valid {format}: {problem}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// `Irap binary surface`, `ROFF grid`, ...
        format: &'static str,
        /// What is wrong and where: byte, line, record.
        problem: String,
    },
    /// No surface can be made of what is there.
    #[error("surface `{surface}`: {problem}")]
    BadSurface {
        /// Its name.
        surface: String,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// The scene refused something.
    #[error(transparent)]
    Scene(#[from] SceneError),
}
