//! Files read whole, as hostile as they may be: pipes without an end and lengths beyond all memory among them.

use std::fs::File;
use std::io::{Error, Read, Result};

/// All bytes of a file that was opened, if they are `largest` at most.
///
/// # Errors
/// What the system says; for what is no regular file, for one that is too large, and where memory does not suffice.
pub fn whole_file(file: File, largest: u64) -> Result<Vec<u8>> {
    let metadata = file.metadata()?;
    if !metadata.is_file() {
        return Err(Error::other(
            "it is no regular file, so that its length is not known",
        ));
    }
    let mut bytes = Vec::new();
    if metadata.len() <= largest {
        let wanted = usize::try_from(metadata.len()).unwrap_or(usize::MAX);
        bytes.try_reserve_exact(wanted).map_err(Error::other)?;
        // It may have grown meanwhile.
        file.take(largest + 1).read_to_end(&mut bytes)?;
    }
    if metadata.len().max(bytes.len() as u64) > largest {
        let problem = format!("larger than {largest} bytes; cut it into parts");
        return Err(Error::other(problem));
    }
    Ok(bytes)
}
