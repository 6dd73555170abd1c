//! A folder of outputs with one writer.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::discard::{Discarded, unfinished};
use crate::lock::{FolderLock, MOST_TRIES};
use crate::part::{self, Part};
use crate::target::real_path;
use crate::together::{FileContents, WriteFailure, replace};

/// A folder that this process alone writes a set of files into, from before the work until its end.
///
/// It is created where it is missing, and removed again if nothing was written into it.
#[derive(Debug)]
pub struct OutFolder {
    path: PathBuf,
    /// Dropped before the folders that hold it.
    lock: Option<FolderLock>,
    /// The folders that were made, the outermost first.
    made: Vec<(PathBuf, Discarded)>,
}

impl OutFolder {
    /// Opens a folder for outputs: creates it, locks it, removes what killed runs left in it, and tries to write. Links are followed.
    ///
    /// # Errors
    /// [`io::ErrorKind::ResourceBusy`] where another run writes into the folder; the system's, for a folder that cannot be created or is
    /// read-only or full. Nothing is left then.
    pub fn open(path: &Path) -> io::Result<Self> {
        let mut folder = Self {
            path: real_path(path),
            lock: None,
            made: Vec::new(),
        };
        let mut tries = 0;
        folder.lock = loop {
            tries += 1;
            let locked = folder.make().and_then(|()| FolderLock::take(&folder.path));
            match locked {
                Ok(lock) => break Some(lock),
                // The run that made a folder has removed it again.
                Err(error) if error.kind() == io::ErrorKind::NotFound && tries < MOST_TRIES => {}
                Err(error) => return Err(error),
            }
        };
        part::sweep(&folder.path);
        Part::probe(&folder.path)?;
        Ok(folder)
    }

    /// Creates the folders that are missing.
    fn make(&mut self) -> io::Result<()> {
        let missing = self.path.ancestors().filter(|folder| {
            let named = !folder.as_os_str().is_empty();
            named && fs::symlink_metadata(folder).is_err()
        });
        let missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        for folder in missing.into_iter().rev() {
            let mut list = unfinished();
            match fs::create_dir(&folder) {
                Ok(()) => {
                    let discarded = Discarded::add(&mut list, &folder);
                    self.made.push((folder, discarded));
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
        match fs::metadata(&self.path) {
            Ok(found) if !found.is_dir() => Err(io::ErrorKind::NotADirectory.into()),
            _ => Ok(()),
        }
    }

    /// The folder's real path.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes all files or none, by their names in the folder, as [`write_together`](crate::write_together) does. First the last file's
    /// predecessor is removed, so that a set without its last file is known to be incomplete. Regular files of `old` that are no new ones are
    /// removed before the last file takes its place.
    ///
    /// # Errors
    /// The first file that failed. If it could not be written, or the last file's predecessor not be removed, nothing has changed. If it could
    /// not take its place, the files that took theirs are removed, and what they replaced and the last file's predecessor are lost; where it
    /// was the last one, the files of `old` are removed as well.
    pub fn replace(&self, files: Vec<FileContents>, old: &[String]) -> Result<(), WriteFailure> {
        let files: Vec<FileContents> = files
            .into_iter()
            .map(|file| FileContents {
                path: self.path.join(file.path),
                bytes: file.bytes,
            })
            .collect();
        let old = old.iter().map(|name| self.path.join(name));
        let old = old.filter(|old| files.iter().all(|file| file.path != *old));
        replace(&files, &old.collect::<Vec<PathBuf>>())
    }
}

impl Drop for OutFolder {
    fn drop(&mut self) {
        self.lock = None;
        // A folder that another run makes in its place is not on the list of this process.
        let mut list = unfinished();
        while let Some((folder, mut discarded)) = self.made.pop() {
            // Where something is in it, it stays.
            let _ = fs::remove_dir(folder);
            discarded.take_off(&mut list);
        }
    }
}
