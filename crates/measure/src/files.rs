//! Reads files with a size limit, and writes whole files.

use std::io::{ErrorKind, Write};
use std::path::Path;

use antumbra_files::WholeFile;

use crate::MeasureError;

/// Reads a whole file of at most `limit` bytes.
pub(crate) fn read_limited(
    path: &Path,
    kind: &'static str,
    limit: u64,
) -> Result<Vec<u8>, MeasureError> {
    let path = path.to_owned();
    antumbra_files::read_whole_file(&path, limit).map_err(|source| match source.kind() {
        ErrorKind::FileTooLarge => MeasureError::TooLarge { path, kind, limit },
        _ => MeasureError::File {
            action: "read",
            path,
            source,
        },
    })
}

/// Writes a file whole, or not at all.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), MeasureError> {
    let written = WholeFile::create(path).and_then(|mut file| {
        file.file().write_all(bytes)?;
        file.finish()
    });
    written.map_err(|source| MeasureError::File {
        action: "write",
        path: path.to_owned(),
        source,
    })
}
