//! A volume file as a source of bricks, mapped into memory. [`format`](super::format) describes its bytes.

use std::fs::File;
use std::path::{Path, PathBuf};

use memmap2::{Advice, Mmap};

use super::format::{self, FORMAT, HEADER};
use super::{BrickSource, VolumeLayout};
use crate::error::SubsurfaceError;

/// A volume in a file, mapped into memory: however large it is, what it holds of the machine's memory is given back brick by brick.
///
/// The file must not be changed while it is open. Written anew by [`write_volume`](super::write_volume) it is another file, and harms nobody.
#[derive(Debug)]
pub struct VolumeFile {
    path: PathBuf,
    name: String,
    layout: VolumeLayout,
    map: Mmap,
}

impl VolumeFile {
    /// Opens a volume file and checks all that its header says. Nothing of the bricks is read.
    ///
    /// # Errors
    /// [`SubsurfaceError::File`] when the system refuses; [`SubsurfaceError::Format`] for a file without the mark or of another version, with
    /// impossible numbers, or of another length than its header says.
    pub fn open(path: &Path) -> Result<Self, SubsurfaceError> {
        let failed = |source| SubsurfaceError::File {
            action: "open",
            path: path.into(),
            source,
        };
        let bad = |problem| SubsurfaceError::Format {
            path: path.into(),
            format: FORMAT,
            problem,
        };
        // Before it is opened: a pipe would wait for somebody to write.
        if !std::fs::metadata(path).map_err(failed)?.is_file() {
            return Err(bad("it is not a regular file".into()));
        }
        let file = File::open(path).map_err(failed)?;
        // SAFETY: memory that a file backs is sound to look at as long as nobody changes the file. No program can rule that out, so every
        // library asks for `unsafe` here. Those of our programs that write volumes rename a finished file into place and never change one, the
        // map is read-only, and its bytes are only ever copied out as numbers of which every pattern is valid. A file that another program cuts
        // short while it is open ends this one with a bus error.
        let map = unsafe { Mmap::map(&file) }.map_err(failed)?;
        let (layout, name) = format::decode(&map, map.len() as u64).map_err(bad)?;
        #[cfg(unix)]
        if let Err(error) = map.advise(Advice::Random) {
            tracing::debug!(%error, "the system takes no advice about reading ahead");
        }
        Ok(Self {
            path: path.into(),
            name,
            layout,
            map,
        })
    }

    /// The volume's name, for people; may be empty.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Tells the system that the pages around some bytes are no longer looked at.
    #[cfg(unix)]
    fn give_back(&self, start: usize, length: usize) {
        /// Systems map pages around the one asked for: Linux as many as it holds in one piece, up to this many bytes.
        const AROUND: usize = 2 << 20;
        let from = start.saturating_sub(AROUND);
        let until = (start + length + AROUND).min(self.map.len());
        // SAFETY: the advice is unsafe for maps whose changed pages would be lost. This one is read-only and backed by a file: a page that is
        // given back is read from the file again when somebody looks at it.
        let given = unsafe {
            (self.map).unchecked_advise_range(
                memmap2::UncheckedAdvice::DontNeed,
                from,
                until - from,
            )
        };
        if let Err(error) = given {
            tracing::debug!(%error, "the system does not take pages back");
        }
    }

    #[cfg(not(unix))]
    fn give_back(&self, _start: usize, _length: usize) {}
}

impl BrickSource for VolumeFile {
    fn layout(&self) -> &VolumeLayout {
        &self.layout
    }

    fn read(&self, brick: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError> {
        let rank = self.layout.check_read(brick, samples)?;
        // The file's length was checked against the layout: no brick's end lies beyond it.
        let start = HEADER + rank as usize * samples.len();
        samples.copy_from_slice(&self.map[start..start + samples.len()]);
        self.give_back(start, samples.len());
        Ok(())
    }
}
