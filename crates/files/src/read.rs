//! Reading of regular files.

use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::Path;

use crate::kind::kind;
use crate::memory::MemoryBudget;

/// Opens a regular file for reading. Links are followed.
///
/// # Errors
/// The system's, and anything but a regular file. A FIFO is not opened, since that would wait for a writer.
pub fn open(path: &Path) -> io::Result<File> {
    check(&fs::metadata(path)?)?;
    let file = File::open(path)?;
    // Another file may have taken its place meanwhile.
    check(&file.metadata()?)?;
    Ok(file)
}

fn check(found: &Metadata) -> io::Result<()> {
    match found.file_type() {
        file if file.is_file() => Ok(()),
        folder if folder.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        other => Err(io::Error::other(format!(
            "it is {}, which may never end: name a regular file",
            kind(other)
        ))),
    }
}

/// The contents of a regular file, if it has at most `largest` bytes.
///
/// # Errors
/// As for [`open`]; a file that is too large; insufficient memory.
pub fn read_whole_file(path: &Path, largest: u64) -> io::Result<Vec<u8>> {
    let file = open(path)?;
    let length = file.metadata()?.len();
    let mut bytes = Vec::new();
    if length <= largest {
        let wanted = usize::try_from(length).unwrap_or(usize::MAX);
        bytes.try_reserve_exact(wanted).map_err(io::Error::other)?;
        // The file may have grown meanwhile.
        file.take(largest.saturating_add(1))
            .read_to_end(&mut bytes)?;
    }
    if length.max(bytes.len() as u64) > largest {
        return Err(io::Error::new(
            io::ErrorKind::FileTooLarge,
            format!("larger than {largest} bytes; cut it into parts"),
        ));
    }
    Ok(bytes)
}

/// As [`read_whole_file`], for a load that may take `max_memory` bytes.
///
/// # Errors
/// As for [`read_whole_file`]; a file that is larger than the load's memory.
pub fn read_whole_file_within(path: &Path, largest: u64, max_memory: u64) -> io::Result<Vec<u8>> {
    let length = fs::metadata(path)?.len();
    MemoryBudget::new(max_memory)
        .allow(length, || "the file")
        .map_err(|over| io::Error::new(io::ErrorKind::FileTooLarge, over))?;
    // The file may have grown meanwhile.
    read_whole_file(path, largest.min(max_memory))
}
