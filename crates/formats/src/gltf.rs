//! glTF 2.0, read and written.

pub(crate) mod read;
mod write;

pub use write::{SaveError, SaveProblem, save_glb, save_glb_with_attachments};
