//! A memory-mapped volume file as a source of bricks. [`file_format`](super::file_format) describes its bytes.

use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::sync::atomic::{AtomicU64, Ordering};

use memmap2::{Advice, Mmap};

use super::file_format::{self, FORMAT, HEADER_BYTES, Header};
use super::layout::VolumeLayout;
use super::source::BrickSource;
use crate::error::SubsurfaceError;

/// A memory-mapped volume file. After some bricks their memory is returned to the system, so a file of any size can be
/// read.
///
/// The file must not be changed while it is open. [`write_volume`](super::write_volume) replaces a file by a new one,
/// which is safe.
#[derive(Debug)]
pub struct VolumeFile {
    path: PathBuf,
    name: String,
    layout: VolumeLayout,
    map: Mmap,
    /// About how many bytes are mapped since pages were returned.
    #[cfg(unix)]
    mapped: AtomicU64,
}

impl VolumeFile {
    /// Opens a volume file and checks its header. No brick is read.
    ///
    /// # Errors
    /// [`SubsurfaceError::File`] for an error of the system; [`SubsurfaceError::Format`] for a file without the
    /// signature, of another version, with invalid numbers, or of another length than its header specifies.
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
        let file = antumbra_files::open(path).map_err(failed)?;
        // SAFETY: a file mapping is sound as long as the file does not change. No program can guarantee that, so
        // every library requires `unsafe` here. Our programs that write volumes rename a finished file into place and
        // never change one. The mapping is read-only, and its bytes are only copied out as numbers for which every
        // bit pattern is valid. If another program truncates the file while it is open, this program ends with a bus
        // error.
        let map = unsafe { Mmap::map(&file) }.map_err(failed)?;
        let Header { layout, name } = file_format::decode(&map, map.len() as u64).map_err(bad)?;
        #[cfg(unix)]
        if let Err(error) = map.advise(Advice::Random) {
            tracing::debug!(%error, "the system takes no advice about reading ahead");
        }
        Ok(Self {
            path: path.into(),
            name,
            layout,
            map,
            #[cfg(unix)]
            mapped: AtomicU64::new(0),
        })
    }

    /// The volume's name; may be empty.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The path of the file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Counts what a brick has mapped, and returns the pages of the whole file to the system before it is too much. To do so after each brick
    /// would take far longer than to read a small one.
    #[cfg(unix)]
    fn give_back(&self, length: usize) {
        /// Systems also map pages around the requested one.
        const AROUND: u64 = 64 << 10;
        /// The bytes that may be mapped meanwhile.
        const MOST: u64 = 1 << 20;
        let mapped = length as u64 + AROUND;
        if self.mapped.fetch_add(mapped, Ordering::Relaxed) + mapped < MOST {
            return;
        }
        self.mapped.store(0, Ordering::Relaxed);
        // SAFETY: the advice is unsafe for mappings whose changed pages would be lost. This one is read-only and
        // backed by a file: a page that was returned is read from the file again on the next access.
        let given = unsafe { (self.map).unchecked_advise(memmap2::UncheckedAdvice::DontNeed) };
        if let Err(error) = given {
            tracing::debug!(%error, "the system does not take pages back");
        }
    }

    #[cfg(not(unix))]
    fn give_back(&self, _length: usize) {}
}

impl BrickSource for VolumeFile {
    fn layout(&self) -> &VolumeLayout {
        &self.layout
    }

    fn read(&self, brick: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError> {
        let rank = self.layout.check_read(brick, samples)?;
        // The file's length was checked against the layout, so no brick's end is beyond it.
        let start = HEADER_BYTES + rank as usize * samples.len();
        samples.copy_from_slice(&self.map[start..start + samples.len()]);
        self.give_back(samples.len());
        Ok(())
    }
}
