//! Errors in the text of a job.

use thiserror::Error;

/// Why a WGSL text is not a valid job.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ShaderError {
    /// A `//!` line that is not `//!import name`.
    #[error(
        "{file}:{line}: unknown directive `{directive}`; write `//!import name`, or `//` for a comment"
    )]
    Directive {
        /// The line's file.
        file: String,
        /// Line, from 1.
        line: u32,
        /// The line's text.
        directive: String,
    },
    /// An import that is not at the start of the file.
    #[error(
        "{file}:{line}: imports come first in a file, before comments and code; move this line up"
    )]
    LateImport {
        /// The line's file.
        file: String,
        /// Line, from 1.
        line: u32,
    },
    /// An import of a file that does not exist.
    #[error("{file}:{line}: there is no shared file `{name}`; there are: {known}")]
    UnknownImport {
        /// The import's file.
        file: String,
        /// Line, from 1.
        line: u32,
        /// The imported name.
        name: String,
        /// The names that exist.
        known: String,
    },
    /// Shared files that import each other in a cycle.
    #[error(
        "{file}:{line}: this import closes a cycle: {chain}; move what both need into a third shared file"
    )]
    ImportCycle {
        /// The import's file.
        file: String,
        /// Line, from 1.
        line: u32,
        /// `a -> b -> a`.
        chain: String,
    },
    /// An error of naga, with the original files and lines.
    #[error("{report}")]
    Invalid {
        /// The rendered report.
        report: String,
        /// The file of the first reported location, if there is one.
        file: Option<String>,
        /// Its line, from 1.
        line: Option<u32>,
    },
    /// The text has no entry point.
    #[error(
        "{file}: no entry point; text that others import belongs into `shared`, a job needs @vertex, @fragment or @compute"
    )]
    NoEntryPoint {
        /// The job's file.
        file: String,
    },
    /// Two variables have the same place.
    #[error(
        "{file}: `{first}` and `{second}` are both @group({group}) @binding({binding}); give one of them another number, or a file of its own"
    )]
    SharedBinding {
        /// The job's file.
        file: String,
        /// Group of both.
        group: u32,
        /// Binding number of both.
        binding: u32,
        /// A variable's name.
        first: String,
        /// A variable's name.
        second: String,
    },
    /// A group number exceeds wgpu's limit.
    #[error(
        "{file}: `{variable}` is in @group({group}), but wgpu has groups 0 to {last}; use a lower number"
    )]
    GroupNumber {
        /// The job's file.
        file: String,
        /// The variable's name.
        variable: String,
        /// Its group.
        group: u32,
        /// The highest possible group number.
        last: u32,
    },
    /// No bind group layout can hold the resource.
    #[error(
        "{file}: `{variable}` is a resource that bind group layouts cannot hold; use a buffer, texture or sampler"
    )]
    Unbindable {
        /// The job's file.
        file: String,
        /// The variable's name.
        variable: String,
    },
}
