//! The errors of loading.

use antumbra_files::{OverBudget, words};
use antumbra_scene::SceneError;
use antumbra_scene::animation::AnimationError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a file could not be loaded.
#[derive(Debug, Error)]
#[error("{}", message(file.as_deref(), problem))]
pub struct LoadError {
    /// The file; `None` if it was read from memory.
    pub file: Option<PathBuf>,
    /// The problem.
    pub problem: Box<LoadProblem>,
}

/// The message: what it quotes of the file is clean and not too long.
fn message(file: Option<&Path>, problem: &LoadProblem) -> String {
    let problem_in_words = words::short(&problem.to_string(), 500);
    format!("{}{problem_in_words}", prefix(file, problem))
}

/// The file's name before a problem that does not name it.
fn prefix(file: Option<&Path>, problem: &LoadProblem) -> String {
    let Some(file) = file.map(|file| file.display().to_string()) else {
        return String::new();
    };
    match problem {
        LoadProblem::Io { file: named, .. } if *named == file => String::new(),
        _ => format!("{file}: "),
    }
}

/// A problem of a file. Each case gives the problem, its place and the remedy.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LoadProblem {
    /// The file name extension is unknown.
    #[error(
        "files with the extension \"{extension}\" cannot be read; the known extensions are .{}: convert the file to one of these formats",
        known.join(", .")
    )]
    UnknownExtension {
        /// The extension without the dot.
        extension: String,
        /// The known extensions.
        known: &'static [&'static str],
    },
    /// The operating system reported an error.
    #[error("cannot read {file}: {source}")]
    Io {
        /// The file.
        file: String,
        /// Why.
        #[source]
        source: std::io::Error,
    },
    /// The file exceeds a limit of [`LoadOptions`](crate::LoadOptions).
    #[error(
        "{amount} {what} are more than the {limit} allowed: raise LoadOptions::{option} if you trust the file"
    )]
    TooLarge {
        /// The limited quantity.
        what: &'static str,
        /// The amount in the file.
        amount: u64,
        /// The limit.
        limit: u64,
        /// The option with the limit.
        option: &'static str,
    },
    /// The file would take more memory than [`LoadOptions::max_memory`](crate::LoadOptions::max_memory).
    #[error(transparent)]
    TooMuchMemory(#[from] OverBudget),
    /// The file would take more work than [`LoadOptions::max_work`](crate::LoadOptions::max_work).
    #[error(
        "{part} takes {steps} steps of work, more than the {limit} allowed: raise LoadOptions::max_work if you trust the file"
    )]
    TooMuchWork {
        /// The part of the file.
        part: String,
        /// The steps so far, with those of this part.
        steps: u64,
        /// The limit.
        limit: u64,
    },
    /// The file is shorter than it declares.
    #[error(
        "{what} needs {needed} bytes, but there are only {available}: the file is truncated or its lengths are wrong; get it again"
    )]
    Truncated {
        /// The truncated part.
        what: String,
        /// The bytes that it should have.
        needed: u64,
        /// The bytes that it has.
        available: u64,
    },
    /// The contents are invalid.
    #[error("{place} is not valid {format}: {problem}")]
    Syntax {
        /// The format.
        format: &'static str,
        /// The place, as far as known.
        place: String,
        /// The problem.
        problem: String,
    },
    /// The file requires an unsupported extension.
    #[error("the file requires the extension {name}; supported are {}: export it without that extension", supported.join(", "))]
    UnsupportedExtension {
        /// The first such extension.
        name: String,
        /// The supported extensions.
        supported: &'static [&'static str],
    },
    /// A reference to something that does not exist.
    #[error(
        "{place} refers to {what} {index}, but there are {count}: the file is invalid; export it again"
    )]
    MissingReference {
        /// The place of the reference.
        place: String,
        /// The kind of the missing thing.
        what: &'static str,
        /// Which one.
        index: u64,
        /// The number of such things.
        count: usize,
    },
    /// A buffer or image without bytes.
    #[error("{place} has no data: {problem}")]
    MissingData {
        /// The buffer or image.
        place: String,
        /// The reason, and the remedy.
        problem: String,
    },
    /// A reference to a file that is not opened.
    #[error("{place} refers to \"{uri}\": {problem}")]
    BadUri {
        /// The place of the reference.
        place: String,
        /// The reference, shortened.
        uri: String,
        /// The reason, and the remedy.
        problem: &'static str,
    },
    /// An accessor whose layout contradicts its use or its bytes.
    #[error("{accessor}: {problem}")]
    BadAccessor {
        /// The accessor and its user.
        accessor: String,
        /// The problem.
        problem: String,
    },
    /// A primitive whose parts do not fit together.
    #[error("{primitive}: {problem}")]
    BadPrimitive {
        /// Mesh and primitive.
        primitive: String,
        /// The problem.
        problem: String,
    },
    /// A node with an invalid transform.
    #[error("{node}: {problem}")]
    BadNode {
        /// Which one.
        node: String,
        /// The problem.
        problem: String,
    },
    /// A cycle of nodes.
    #[error("{node} is its own ancestor: a scene must be a tree; export the file again")]
    NodeCycle {
        /// One node of the cycle.
        node: String,
    },
    /// A node with two parents.
    #[error(
        "{node} is a child of both {first} and {second}: a node has one parent; export the file again"
    )]
    TwoParents {
        /// The node.
        node: String,
        /// One parent.
        first: String,
        /// The other.
        second: String,
    },
    /// The properties of an attachment are invalid.
    #[error("the extension {attachment}: {problem}; write it again")]
    BadAttachment {
        /// Its name.
        attachment: String,
        /// The problem.
        problem: String,
    },
    /// Parts of the file were left out, and [`LoadOptions::strict`](crate::LoadOptions::strict) forbids it.
    #[error(
        "a strict load leaves nothing out, but these would be: {left_out}; load it without strictness, or export it without them"
    )]
    LeftOut {
        /// The parts, by kind and reason.
        left_out: String,
    },
    /// The scene shows nothing.
    #[error("it has nothing to draw{}", reason_for_nothing(left_out))]
    NothingToDraw {
        /// What was left out; empty for a file that has nothing.
        left_out: String,
    },
    /// The parts of an animation do not fit together.
    #[error(transparent)]
    Animation(#[from] AnimationError),
    /// The scene refused what was read.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

fn reason_for_nothing(left_out: &str) -> String {
    match left_out {
        "" => ": no mesh, line or point is in it; export it again with its geometry".to_owned(),
        left_out => format!(": left out were {left_out}"),
    }
}

pub(crate) use antumbra_files::words::name as shorten;
