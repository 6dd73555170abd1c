//! The memory that the first directory of a TIFF becomes. The crate `tiff` reserves a list for all values that a tag declares before it reads
//! the first one, up to 256 MiB, and before its limits can be set. So the counts are read here first.

use std::iter::from_fn;

use antumbra_files::MemoryBudget;
use tiff::decoder::ifd::Value;
use tiff::tags::Type;

/// Bytes of a value: one of a list of all kinds, and then a number.
const VALUE: u64 = (size_of::<Value>() + size_of::<u64>()) as u64;
/// Bytes of an entry of the directory, with what the map that holds it takes.
const ENTRY: u64 = 64;

/// Takes the memory of all values that the first directory declares. What is malformed is left to the decoder.
pub(super) fn take(bytes: &[u8], memory: &mut MemoryBudget) -> Result<(), String> {
    for (tag, count) in entries(bytes).into_iter().flatten() {
        let bytes = count.saturating_mul(VALUE).saturating_add(ENTRY);
        let taken = memory.take(bytes, || format!("its tag {tag} of {count} values"));
        taken.map_err(|over| over.to_string())?;
    }
    Ok(())
}

/// The tags of the first directory and the number of their values, as the decoder reads them.
fn entries(bytes: &[u8]) -> Option<impl Iterator<Item = (u64, u64)>> {
    let mut file = Numbers {
        bytes,
        at: 2,
        is_little: bytes.starts_with(b"II"),
    };
    let (offset, count) = match file.next(2)? {
        42 => (4, 2),
        43 => {
            file.next(4)?;
            (8, 8)
        }
        _ => return None,
    };
    file.at = usize::try_from(file.next(offset)?).ok()?;
    let mut left = file.next(count)?;
    Some(from_fn(move || {
        left = left.checked_sub(1)?;
        let tag = file.next(2)?;
        let kind = u16::try_from(file.next(2)?).ok()?;
        if Type::from_u16(kind).is_none() {
            // The decoder skips so many bytes also where offsets are longer.
            file.next(8)?;
            return Some((tag, 0));
        }
        let values = file.next(offset)?;
        file.next(offset)?;
        Some((tag, values))
    }))
}

/// Numbers of a file, in its order of bytes.
struct Numbers<'a> {
    bytes: &'a [u8],
    at: usize,
    is_little: bool,
}

impl Numbers<'_> {
    /// The next number, of so many bytes.
    fn next(&mut self, length: usize) -> Option<u64> {
        let end = self.at.checked_add(length)?;
        let number = self.bytes.get(self.at..end)?.iter();
        self.at = end;
        let append = |number: u64, byte: &u8| (number << 8) | u64::from(*byte);
        Some(match self.is_little {
            true => number.rev().fold(0, append),
            false => number.fold(0, append),
        })
    }
}
