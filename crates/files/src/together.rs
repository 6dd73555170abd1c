//! Several files that appear together, or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::discard::{Unfinished, unfinished};
use crate::whole::WholeFile;

/// A file's path and contents.
#[derive(Debug, Clone)]
pub struct FileContents {
    /// Its path.
    pub path: PathBuf,
    /// All its bytes.
    pub bytes: Vec<u8>,
}

/// A file that could not be written.
#[derive(Debug)]
pub struct WriteFailure {
    /// Its path.
    pub path: PathBuf,
    /// Why.
    pub source: io::Error,
}

/// Writes all files or none. All of them are written and flushed to the device before the first takes its place, so that a full device, a
/// quota or a missing right is found while nothing has changed. The last file takes its place last.
///
/// Only the loss of power and a signal that cannot be caught can come between two renames.
///
/// # Errors
/// The first file that failed. If it could not be written, nothing has changed. If it could not take its place (its folder was removed
/// meanwhile), the files that took theirs are removed, and what they replaced is lost.
pub fn write_together(files: &[FileContents]) -> Result<(), WriteFailure> {
    let complete = complete(files)?;
    take_places(complete, unfinished(), &[])
}

/// As [`write_together`]. The last file's predecessor is removed before the first file takes its place. The regular files of `old` that are no
/// new ones are removed before the last file takes its place: afterwards, a run that is killed between would leave files that no set names. What
/// of `old` cannot be removed stays.
pub(crate) fn replace(files: &[FileContents], old: &[PathBuf]) -> Result<(), WriteFailure> {
    let complete = complete(files)?;
    let held = unfinished();
    if let Some(last) = complete.last() {
        let removed = match fs::remove_file(last.target()) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            removed => removed,
        };
        removed.map_err(failure(last.target()))?;
    }
    take_places(complete, held, old)
}

/// All files, written and flushed beside their places.
fn complete(files: &[FileContents]) -> Result<Vec<WholeFile>, WriteFailure> {
    let complete = files.iter().map(|file| {
        let failed = failure(&file.path);
        let mut whole = WholeFile::create(&file.path).map_err(&failed)?;
        let written = whole.file().write_all(&file.bytes);
        written.and_then(|()| whole.complete()).map_err(failed)?;
        Ok(whole)
    });
    complete.collect()
}

fn take_places(
    complete: Vec<WholeFile>,
    mut held: Unfinished,
    old: &[PathBuf],
) -> Result<(), WriteFailure> {
    let mut placed: Vec<PathBuf> = Vec::with_capacity(complete.len());
    let mut rest = complete.into_iter();
    let mut failed = Ok(());
    while let Some(whole) = rest.next() {
        if rest.len() == 0 {
            // A new file that was written through a link can have an old name.
            let gone = old.iter().filter(|old| !placed.contains(old));
            gone.for_each(|old| remove_regular(old));
        }
        let path = whole.target().to_owned();
        if let Err(source) = whole.take_place(&mut held) {
            for path in &placed {
                // The error that is returned is the first one.
                let _ = fs::remove_file(path);
            }
            failed = Err(WriteFailure { path, source });
            break;
        }
        placed.push(path);
    }
    // Parts take themselves off the list.
    drop(held);
    failed
}

/// Removes a regular file. A folder, a link or a device is none of ours.
fn remove_regular(path: &Path) {
    if fs::symlink_metadata(path).is_ok_and(|found| found.is_file())
        && let Err(error) = fs::remove_file(path)
    {
        tracing::debug!(%error, path = %path.display(), "a file of an earlier set stays");
    }
}

fn failure(path: &Path) -> impl Fn(io::Error) -> WriteFailure {
    |source| WriteFailure {
        path: path.to_owned(),
        source,
    }
}
