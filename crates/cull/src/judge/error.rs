//! Why instances cannot be judged.

use antumbra_graph::{CompileErrors, ExecuteError};
use thiserror::Error;

/// Why instances cannot be judged.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum JudgeError {
    /// An instance's box cannot be used.
    #[error("instance {index}: {why}")]
    Instance {
        /// Its index; in a slice of new ones, its place there.
        index: u32,
        /// What is wrong with it, and what to do.
        why: String,
    },
    /// An id that means no instance: it was removed, or comes from another set.
    #[error(
        "instance {index} of generation {generation} does not exist: it was removed, or its id is of another set"
    )]
    Unknown {
        /// Its index.
        index: u32,
        /// Its generation.
        generation: u32,
    },
    /// A slice that names an instance twice.
    #[error("instance {index} is named twice in one slice: leave one of them out")]
    Twice {
        /// Its index.
        index: u32,
    },
    /// More instances than the device's buffers hold.
    #[error(
        "{instances} instances need a buffer of {bytes} bytes, and this device's end at {most}: split them into several sets"
    )]
    TooMany {
        /// The instances that were asked for.
        instances: u64,
        /// The size of their buffer in bytes.
        bytes: u64,
        /// The device's limit in bytes.
        most: u64,
    },
    /// A view that cannot be judged for.
    #[error("view '{view}': {why}")]
    View {
        /// Its name.
        view: String,
        /// What is wrong with it, and what to do.
        why: String,
    },
    /// A depth that does not fit its view.
    #[error("the depth of view '{view}' {why}")]
    Depth {
        /// The view's name.
        view: String,
        /// What is wrong with it, and what to do.
        why: String,
    },
    /// A buffer of the caller's that cannot be used.
    #[error("buffer '{buffer}' {why}")]
    Buffer {
        /// What the buffer is for.
        buffer: &'static str,
        /// What is wrong with it, and what to do.
        why: String,
    },
    /// The device lacks what the call needs.
    #[error("the device lacks {0}")]
    Device(&'static str),
    /// A call that does not fit the ones before it.
    #[error("{0}")]
    Order(&'static str),
    /// The passes cannot be compiled for this device.
    #[error(transparent)]
    Compile(#[from] CompileErrors),
    /// A frame failed.
    #[error(transparent)]
    Frame(#[from] ExecuteError),
}
