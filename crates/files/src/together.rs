//! Several files that appear together, or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::discard::unfinished;
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
/// The first file that failed. Nothing has changed then.
pub fn write_together(files: &[FileContents]) -> Result<(), WriteFailure> {
    replace(files, &[])
}

/// As [`write_together`]; `old` are removed right before the first file takes its place.
pub(crate) fn replace(files: &[FileContents], old: &[PathBuf]) -> Result<(), WriteFailure> {
    let mut complete = Vec::with_capacity(files.len());
    for file in files {
        let failed = failure(&file.path);
        let mut whole = WholeFile::create(&file.path).map_err(&failed)?;
        let written = whole.file().write_all(&file.bytes);
        written.and_then(|()| whole.complete()).map_err(failed)?;
        complete.push(whole);
    }
    let mut held = unfinished();
    for path in old {
        remove(path).map_err(failure(path))?;
    }
    let mut placed: Vec<PathBuf> = Vec::with_capacity(complete.len());
    let mut rest = complete.into_iter();
    let failed = rest.by_ref().find_map(|whole| {
        let path = whole.target().to_owned();
        match whole.take_place(&mut held) {
            Ok(()) => {
                placed.push(path);
                None
            }
            Err(source) => Some(WriteFailure { path, source }),
        }
    });
    // Parts take themselves off the list.
    drop(held);
    drop(rest);
    match failed {
        None => Ok(()),
        Some(failed) => {
            for path in placed {
                // The error that is returned is the first one.
                let _ = fs::remove_file(path);
            }
            Err(failed)
        }
    }
}

fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

fn failure(path: &Path) -> impl Fn(io::Error) -> WriteFailure {
    |source| WriteFailure {
        path: path.to_owned(),
        source,
    }
}
