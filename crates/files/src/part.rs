//! Parts: unfinished files. Their names are random and never of a process id, since processes of other PID namespaces share folders.

use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::Path;

use tempfile::TempPath;

use crate::discard::{Discarded, Unfinished, unfinished};
use crate::lock::{MOST_TRIES, is_at};

const PREFIX: &str = ".antumbra-";
const SUFFIX: &str = ".partial";
/// Random letters of a part's name.
const LETTERS: usize = 12;

/// An unfinished file. It is removed unless it is renamed.
#[derive(Debug)]
pub(crate) struct Part {
    path: TempPath,
    file: File,
    discarded: Discarded,
}

impl Part {
    /// A new, empty part in a folder, with the permissions of an ordinary new file.
    pub(crate) fn create(folder: &Path) -> io::Result<Self> {
        for _ in 0..MOST_TRIES {
            let mut builder = tempfile::Builder::new();
            builder.prefix(PREFIX).suffix(SUFFIX).rand_bytes(LETTERS);
            #[cfg(unix)]
            {
                use std::os::unix::fs::PermissionsExt;
                builder.permissions(fs::Permissions::from_mode(0o666));
            }
            let (file, path, discarded) = {
                // A signal that ends the process finds the part in the list, or no part.
                let mut unfinished = unfinished();
                let (file, path) = builder.tempfile_in(folder)?.into_parts();
                let discarded = Discarded::add(&mut unfinished, &path);
                (file, path, discarded)
            };
            // Where the file system has no locks, leftovers are not told apart, and none is swept.
            match file.lock() {
                // Another process took the part for a leftover before it was locked.
                Ok(()) if !is_at(&file, &path) => continue,
                Ok(()) => {}
                Err(error) => tracing::debug!(%error, "a part cannot be locked"),
            }
            return Ok(Self {
                path,
                file,
                discarded,
            });
        }
        Err(io::Error::other(
            "what is created in its folder is removed at once: name another folder",
        ))
    }

    /// Tries whether a folder takes files.
    pub(crate) fn probe(folder: &Path) -> io::Result<()> {
        let mut part = Self::create(folder)?;
        // More than what some file systems keep in the folder itself.
        part.file.write_all(&[0; 4096])?;
        part.file.sync_data()
    }

    pub(crate) fn file(&mut self) -> &mut File {
        &mut self.file
    }

    /// Renames the part. The caller holds the list of unfinished files, so that a set of renames is not interrupted.
    pub(crate) fn rename(self, held: &mut Unfinished, to: &Path) -> io::Result<()> {
        let Self {
            path,
            file,
            mut discarded,
        } = self;
        let renamed = path.persist(to).map_err(|refused| refused.error);
        drop(file);
        match &renamed {
            Ok(()) => discarded.finish(held),
            Err(_) => discarded.take_off(held),
        }
        renamed
    }
}

/// Removes the parts in a folder that no process is writing any more: what killed processes left behind. Whatever goes wrong is left as it is.
pub fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let is_part = name.to_str().is_some_and(is_part_name);
        if is_part && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            sweep_part(&entry.path());
        }
    }
}

fn is_part_name(name: &str) -> bool {
    let letters = name
        .strip_prefix(PREFIX)
        .and_then(|name| name.strip_suffix(SUFFIX));
    letters.is_some_and(|letters| {
        letters.len() == LETTERS && letters.bytes().all(|letter| letter.is_ascii_alphanumeric())
    })
}

fn sweep_part(path: &Path) {
    let Ok(file) = File::open(path) else {
        return;
    };
    match file.try_lock() {
        // Removed under the lock: a process that has just made the part finds that it is gone.
        Ok(()) if is_at(&file, path) => {
            if let Err(error) = fs::remove_file(path) {
                tracing::debug!(%error, path = %path.display(), "a leftover stays");
            }
        }
        Ok(()) | Err(TryLockError::WouldBlock) => {}
        Err(TryLockError::Error(error)) => {
            tracing::debug!(%error, "parts cannot be locked here; none is swept");
        }
    }
}
