//! Why a scene could not be saved.

use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// Why a scene could not be saved. No partial file is left, and a previous file is unchanged.
#[derive(Debug, Error)]
#[error("{}: {problem}", file.display())]
pub struct SaveError {
    /// The file.
    pub file: PathBuf,
    /// The problem.
    pub problem: SaveProblem,
}

/// A problem of saving.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SaveProblem {
    /// The operating system reported an error.
    #[error("cannot write: {0}")]
    Io(#[from] io::Error),
    /// The file would exceed the 32-bit length of a GLB.
    #[error("the scene needs {bytes} bytes, but a .glb has at most {limit}: save it in parts")]
    TooLarge {
        /// Bytes of the whole file, as far as known.
        bytes: u64,
        /// The greatest length.
        limit: u64,
    },
    /// A material that glTF cannot represent.
    #[error("material \"{material}\": {problem}")]
    BadMaterial {
        /// Its name.
        material: String,
        /// The problem, and the remedy.
        problem: String,
    },
    /// A camera that glTF cannot represent.
    #[error("the camera of entity \"{entity}\": {problem}")]
    BadCamera {
        /// The entity's name.
        entity: String,
        /// The problem, and the remedy.
        problem: String,
    },
    /// An attachment that the file cannot contain.
    #[error("the attachment \"{attachment}\": {problem}")]
    BadAttachment {
        /// Its name.
        attachment: String,
        /// The problem, and the remedy.
        problem: &'static str,
    },
    /// An image that cannot be encoded.
    #[error("image \"{image}\": {problem}")]
    BadImage {
        /// Its name.
        image: String,
        /// Why.
        problem: String,
    },
}
