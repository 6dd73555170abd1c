//! glTF 2.0: reading, writing, and attachments.

pub(crate) mod attachment;
pub(crate) mod read;
mod write;

pub use attachment::Attachment;
pub use write::{SaveError, SaveProblem, save_glb, save_glb_with_attachments};
