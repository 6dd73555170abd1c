//! The lock of a folder: a file that its holder has locked, and removes at the end. The system frees the lock of a killed process.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use crate::discard::{Discarded, unfinished};

/// How often a step is tried again that another process has undone.
pub(crate) const MOST_TRIES: u32 = 100;

/// The name of the lock's file.
pub(crate) const LOCK_NAME: &str = ".antumbra.lock";

/// A held lock.
#[derive(Debug)]
pub(crate) struct FolderLock {
    path: PathBuf,
    _file: File,
    discarded: Discarded,
}

impl FolderLock {
    /// Locks a folder.
    ///
    /// # Errors
    /// [`io::ErrorKind::ResourceBusy`] where another run holds the lock; the system's.
    pub(crate) fn take(folder: &Path) -> io::Result<Self> {
        let path = folder.join(LOCK_NAME);
        for _ in 0..MOST_TRIES {
            // A signal that ends the process finds the file in the list, or no file.
            let mut list = unfinished();
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            let file = options.open(&path)?;
            match file.try_lock() {
                // The former holder has removed the file between the two steps.
                Ok(()) if !is_at(&file, &path) => continue,
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => break,
                Err(TryLockError::Error(error)) => {
                    tracing::debug!(%error, "this file system has no locks");
                }
            }
            let discarded = Discarded::add(&mut list, &path);
            return Ok(Self {
                path,
                _file: file,
                discarded,
            });
        }
        Err(io::Error::new(
            io::ErrorKind::ResourceBusy,
            "another run is writing into it: wait until it ends, or name another folder",
        ))
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // A file of that name that another run makes from here on is not on the list of this process.
        let mut list = unfinished();
        // Removed while it is still locked. Elsewhere the file stays: nothing there tells a new file of that name from this one.
        if cfg!(unix) {
            let _ = fs::remove_file(&self.path);
        }
        self.discarded.take_off(&mut list);
    }
}

/// Whether an open file is still the one at a path.
#[cfg(unix)]
pub(crate) fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let both = file
        .metadata()
        .and_then(|one| Ok((one, fs::metadata(path)?)));
    both.is_ok_and(|(one, other)| (one.dev(), one.ino()) == (other.dev(), other.ino()))
}

#[cfg(not(unix))]
pub(crate) fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}
