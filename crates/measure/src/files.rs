//! Reads files with a size limit, and writes files atomically: to a temporary file that is renamed at the end.

use std::fs::{self, File, OpenOptions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

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
    let file = File::open(path).map_err(fail)?;
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

/// Writes `bytes` to a new file beside `path` and renames it to `path`. On failure no file is left behind.
pub(crate) fn write_beside(path: &Path, bytes: &[u8]) -> Result<(), MeasureError> {
    let fail = |source| MeasureError::File {
        action: "write",
        path: path.to_owned(),
        source,
    };
    let beside = name_beside(path);
    let written = OpenOptions::new()
        .write(true)
        .create_new(true)
        .open(&beside)
        .and_then(|mut file| {
            file.write_all(bytes)?;
            file.sync_all()
        });
    written
        .and_then(|()| fs::rename(&beside, path))
        .map_err(|source| {
            // The write has failed already. That the temporary file may stay is less important.
            let _ = fs::remove_file(&beside);
            fail(source)
        })
}

/// A name in the same folder that no other writer uses: unique in this process, and with the process id.
fn name_beside(path: &Path) -> PathBuf {
    static WRITES: AtomicU32 = AtomicU32::new(0);
    let write = WRITES.fetch_add(1, Ordering::Relaxed);
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}-{write}.part", std::process::id()));
    path.with_file_name(name)
}
