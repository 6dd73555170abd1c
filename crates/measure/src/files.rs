//! Reads files with a size limit, and writes whole files.

use std::io::{Read, Write};
use std::path::Path;

use antumbra_files::WholeFile;

use crate::MeasureError;

/// Reads a whole file of at most `limit` bytes. Never allocates more than that, whatever length the file reports.
pub(crate) fn read_limited(
    path: &Path,
    kind: &'static str,
    limit: u64,
) -> Result<Vec<u8>, MeasureError> {
    let fail = |source| MeasureError::File {
        action: "read",
        path: path.to_owned(),
        source,
    };
    let file = antumbra_files::open(path).map_err(fail)?;
    let mut bytes = Vec::new();
    file.take(limit.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(fail)?;
    if bytes.len() as u64 > limit {
        return Err(MeasureError::TooLarge {
            path: path.to_owned(),
            kind,
            limit,
        });
    }
    Ok(bytes)
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
