//! What can be wrong with a file.

use antumbra_scene::SceneError;
use std::path::PathBuf;
use thiserror::Error;

/// Why a file gave no scene.
#[derive(Debug, Error)]
#[error("{}{problem}", file.as_ref().map(|f| format!("{}: ", f.display())).unwrap_or_default())]
pub struct LoadError {
    /// The file that was to be loaded; `None` when it was read from memory.
    pub file: Option<PathBuf>,
    /// What is wrong with it.
    pub problem: Box<LoadProblem>,
}

/// One thing that can be wrong with a file. Each says what, where, and what to do.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LoadProblem {
    /// The extension tells no format.
    #[error(
        "files ending in \"{extension}\" cannot be read; known are .{}: convert the file to one of them",
        known.join(", .")
    )]
    UnknownExtension {
        /// As the path has it, without the dot.
        extension: String,
        /// What can be read.
        known: &'static [&'static str],
    },
    /// The operating system refused.
    #[error("cannot read {file}: {source}")]
    Io {
        /// The file.
        file: String,
        /// Why.
        #[source]
        source: std::io::Error,
    },
    /// The file asks for more than [`LoadOptions`](super::LoadOptions) allows.
    #[error(
        "{amount} {what} are more than the {limit} allowed: raise LoadOptions::{option} if you trust the file"
    )]
    TooLarge {
        /// Of what there is too much.
        what: &'static str,
        /// How much there would be.
        amount: u64,
        /// How much there may be.
        limit: u64,
        /// The option that says so.
        option: &'static str,
    },
    /// The file ends before what it promises.
    #[error(
        "{what} needs {needed} bytes and there are {available}: the file is cut off or its lengths are wrong; get it again"
    )]
    Truncated {
        /// What is cut off.
        what: String,
        /// Bytes it should have.
        needed: u64,
        /// Bytes there are.
        available: u64,
    },
    /// The bytes do not follow the format.
    #[error("{place} is no valid {format}: {problem}")]
    Syntax {
        /// The format.
        format: &'static str,
        /// Where, as far as known.
        place: String,
        /// What is wrong.
        problem: String,
    },
    /// The file says that it cannot be read without an extension that is not known here.
    #[error("the file requires the extension {name}; supported are {}: export it without", supported.join(", "))]
    UnsupportedExtension {
        /// The first such extension.
        name: String,
        /// What is supported.
        supported: &'static [&'static str],
    },
    /// A reference to something that is not there.
    #[error(
        "{place} refers to {what} {index}, but there are {count}: the file was written wrongly; export it again"
    )]
    MissingReference {
        /// Who refers.
        place: String,
        /// To what kind of thing.
        what: &'static str,
        /// Which one.
        index: u64,
        /// How many there are.
        count: usize,
    },
    /// A buffer or image without bytes.
    #[error("{place} has no data: {problem}")]
    MissingData {
        /// Which buffer or image.
        place: String,
        /// Why, and what to do.
        problem: String,
    },
    /// A reference to a file that is not opened.
    #[error("{place} refers to \"{uri}\": {problem}")]
    BadUri {
        /// Who refers.
        place: String,
        /// The reference, shortened.
        uri: String,
        /// Why not, and what to do.
        problem: &'static str,
    },
    /// An accessor whose layout contradicts its use or its bytes.
    #[error("{accessor}: {problem}")]
    BadAccessor {
        /// Which one, and who uses it.
        accessor: String,
        /// What is wrong.
        problem: String,
    },
    /// A primitive whose parts do not fit together.
    #[error("{primitive}: {problem}")]
    BadPrimitive {
        /// Mesh and primitive.
        primitive: String,
        /// What is wrong.
        problem: String,
    },
    /// A node that cannot be placed.
    #[error("{node}: {problem}")]
    BadNode {
        /// Which one.
        node: String,
        /// What is wrong.
        problem: String,
    },
    /// Nodes below themselves.
    #[error("{node} hangs below itself: a scene must be a tree; export the file again")]
    NodeCycle {
        /// One node of the cycle.
        node: String,
    },
    /// A node in two places.
    #[error(
        "{node} hangs below both {first} and {second}: a node has one parent; export the file again"
    )]
    TwoParents {
        /// The node.
        node: String,
        /// One parent.
        first: String,
        /// The other.
        second: String,
    },
    /// What an attachment says of itself does not fit together.
    #[error("the extension {attachment}: {problem}; write it again")]
    BadAttachment {
        /// Its name.
        attachment: String,
        /// What is wrong.
        problem: String,
    },
    /// An image that cannot be decoded.
    #[error("{image}: {problem}; set LoadOptions::skip_images to load the scene without images")]
    BadImage {
        /// Which one.
        image: String,
        /// What is wrong.
        problem: String,
    },
    /// The scene refused what was read.
    #[error(transparent)]
    Scene(#[from] SceneError),
}
