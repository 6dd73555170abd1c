//! One file that is there whole, or not at all.

use std::fs::File;
use std::io;
use std::path::Path;

use crate::discard::{Unfinished, unfinished};
use crate::part::Part;
use crate::target::Target;

/// A file that is written beside its place, and takes its place when it is complete.
///
/// Links are followed: the file that they lead to is replaced, and the links stay. A file that exists keeps its permissions. Unless
/// [`finish`](Self::finish) succeeds, nothing is left, and what was there is unchanged.
#[derive(Debug)]
pub struct WholeFile {
    target: Target,
    part: Part,
}

impl WholeFile {
    /// Begins the file. What is at `path` stays until it is complete.
    ///
    /// # Errors
    /// The system's; a path to what is no regular file, or read-only.
    pub fn create(path: &Path) -> io::Result<Self> {
        let target = Target::of(path)?;
        Ok(Self {
            part: Part::create(target.folder())?,
            target,
        })
    }

    /// The file to write to.
    pub fn file(&mut self) -> &mut File {
        self.part.file()
    }

    /// Puts the complete file into its place.
    ///
    /// # Errors
    /// The system's. Nothing is left then.
    pub fn finish(mut self) -> io::Result<()> {
        self.complete()?;
        self.take_place(&mut unfinished())
    }

    /// Does everything that can fail, except the rename.
    pub(crate) fn complete(&mut self) -> io::Result<()> {
        if let Some(permissions) = &self.target.permissions {
            self.part.file().set_permissions(permissions.clone())?;
        }
        self.part.file().sync_all()
    }

    pub(crate) fn take_place(self, held: &mut Unfinished) -> io::Result<()> {
        self.part.rename(held, &self.target.path)
    }

    pub(crate) fn target(&self) -> &Path {
        &self.target.path
    }
}
