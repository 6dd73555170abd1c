//! Regular files in, whole files out.
//!
//! A reader opens regular files alone: a FIFO or a device where a file should be is refused instead of waited for. A writer writes a *part*,
//! a file with a random name in the folder of its target, which is renamed when it is complete. Each part is locked by its process, so that
//! what a killed process left behind is told from what another one is writing. A folder of outputs has one writer at a time.
//!
//! A [`MemoryBudget`] bounds what one load takes. [`words`] makes what a file says fit for a terminal.
//!
//! All errors are [`std::io::Error`]s whose text says what is wrong; callers add the path.

mod discard;
mod kind;
mod lock;
mod memory;
mod out_folder;
mod part;
mod read;
mod target;
mod together;
mod whole;
pub mod words;

pub use discard::{discard_all, finished};
pub use kind::kind;
pub use memory::{MemoryBudget, OverBudget, default_memory, parse_size, size};
pub use out_folder::OutFolder;
pub use part::sweep;
pub use read::{open, read_whole_file, read_whole_file_within};
pub use target::{probe, real_path};
pub use together::{FileContents, WriteFailure, write_together};
pub use whole::WholeFile;
