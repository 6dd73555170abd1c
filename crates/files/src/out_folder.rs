//! A folder of outputs with one writer.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::discard::{Discarded, unfinished};
use crate::lock::FolderLock;
use crate::part::{self, Part};
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
    /// Opens a folder for outputs: creates it, locks it, removes what killed runs left in it, and tries to write.
    ///
    /// # Errors
    /// [`io::ErrorKind::ResourceBusy`] where another run writes into the folder; the system's, for a folder that cannot be created or is
    /// read-only or full. Nothing is left then.
    pub fn open(path: &Path) -> io::Result<Self> {
        let mut folder = Self {
            path: path.to_owned(),
            lock: None,
            made: Vec::new(),
        };
        loop {
            folder.make()?;
            match FolderLock::take(path) {
                Ok(lock) => folder.lock = Some(lock),
                // The run that made the folder has removed it again.
                Err(error) if error.kind() == io::ErrorKind::NotFound && !path.is_dir() => {
                    continue;
                }
                Err(error) => return Err(error),
            }
            break;
        }
        part::sweep(path);
        Part::probe(path)?;
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
                // Another run has removed the folder around it; the caller tries again.
                Err(error) if error.kind() == io::ErrorKind::NotFound => return self.retry(),
                Err(error) => return Err(error),
            }
        }
        match fs::metadata(&self.path) {
            Ok(found) if !found.is_dir() => Err(io::ErrorKind::NotADirectory.into()),
            _ => Ok(()),
        }
    }

    fn retry(&mut self) -> io::Result<()> {
        fs::create_dir_all(&self.path)
    }

    /// The folder's path.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes all files or none, by their names in the folder, as [`write_together`](crate::write_together) does. Files of `old` that are no
    /// new ones are removed, and so is the last file's predecessor: while files take their places, the last one is not there.
    ///
    /// # Errors
    /// The first file that failed. Nothing has changed then.
    pub fn replace(&self, files: Vec<FileContents>, old: &[String]) -> Result<(), WriteFailure> {
        let files: Vec<FileContents> = files
            .into_iter()
            .map(|file| FileContents {
                path: self.path.join(file.path),
                bytes: file.bytes,
            })
            .collect();
        let last = files.last().map(|file| file.path.clone());
        let old = old.iter().map(|name| self.path.join(name));
        let old = old.filter(|old| files.iter().all(|file| file.path != *old));
        // A link at the last file's place is followed when it is written.
        let last = last.filter(|last| fs::symlink_metadata(last).is_ok_and(|is| is.is_file()));
        let old: Vec<PathBuf> = last.into_iter().chain(old).collect();
        replace(&files, &old)
    }
}

impl Drop for OutFolder {
    fn drop(&mut self) {
        self.lock = None;
        while let Some((folder, _discarded)) = self.made.pop() {
            // Where something is in it, it stays.
            let _ = fs::remove_dir(folder);
        }
    }
}
