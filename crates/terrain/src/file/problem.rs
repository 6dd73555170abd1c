//! Errors about the extension of a file.

use crate::error::TerrainError;

/// An error about the data of the extension.
pub(super) fn bad(problem: impl Into<String>) -> TerrainError {
    TerrainError::BadFile {
        problem: problem.into(),
    }
}
