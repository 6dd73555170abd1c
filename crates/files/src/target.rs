//! Where an output leads, and whether it can be written.

use std::fs::{self, OpenOptions, Permissions};
use std::io;
use std::path::{Component, Path, PathBuf};

use crate::kind::kind;
use crate::part::{self, Part};

/// Links that lead to links, before a path counts as leading nowhere; as many as Linux follows.
const MOST_LINKS: u32 = 40;

/// The absolute path with all links followed, of which the last parts need not exist.
#[must_use]
pub fn real_path(path: &Path) -> PathBuf {
    real(path, MOST_LINKS)
}

fn real(path: &Path, links: u32) -> PathBuf {
    if let Ok(real) = path.canonicalize() {
        return real;
    }
    // A link that leads to nothing yet.
    if let Ok(target) = fs::read_link(path)
        && let Some(links) = links.checked_sub(1)
    {
        let from = path.parent().unwrap_or(Path::new(""));
        return real(&from.join(target), links);
    }
    let mut parts = path.components();
    let last = parts.next_back();
    let before = match parts.as_path() {
        none if none.as_os_str().is_empty() => Path::new("."),
        before => before,
    };
    match last {
        Some(Component::Normal(name)) => real(before, links).join(name),
        Some(Component::ParentDir) => {
            let mut above = real(before, links);
            above.pop();
            above
        }
        // Without a folder to start from, the path as it is.
        _ => path.to_owned(),
    }
}

/// A file to be written: where it is once links are followed, and the permissions of what is there.
#[derive(Debug)]
pub(crate) struct Target {
    pub(crate) path: PathBuf,
    pub(crate) permissions: Option<Permissions>,
}

impl Target {
    /// Refuses what is no regular file, and what may not be written.
    pub(crate) fn of(path: &Path) -> io::Result<Self> {
        let path = real_path(path);
        let found = match fs::metadata(&path) {
            Ok(found) => found,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Ok(Self {
                    path,
                    permissions: None,
                });
            }
            Err(error) => return Err(error),
        };
        if !found.is_file() {
            return Err(io::Error::other(format!(
                "it is {}: name a file",
                kind(found.file_type())
            )));
        }
        let permissions = found.permissions();
        // A rename would replace a read-only file, and so would a privileged user's write.
        if permissions.readonly() {
            return Err(io::Error::new(
                io::ErrorKind::PermissionDenied,
                "it is read-only: name another file, or make it writable",
            ));
        }
        OpenOptions::new().append(true).open(&path)?;
        Ok(Self {
            path,
            permissions: Some(permissions),
        })
    }

    /// The folder that holds the file.
    pub(crate) fn folder(&self) -> &Path {
        match self.path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        }
    }
}

/// Checks that a file can be written, before the work of which it is the result, and sweeps its folder ([`sweep`](crate::sweep)). What is
/// there stays as it is.
///
/// # Errors
/// The system's, for a folder that is missing, read-only or full; a target that is no regular file, or read-only.
pub fn probe(path: &Path) -> io::Result<()> {
    let target = Target::of(path)?;
    part::sweep(target.folder());
    Part::probe(target.folder())
}
