//! What can be wrong with a job's text, and with putting jobs together.

use thiserror::Error;

/// Why a WGSL text is no job.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ShaderError {
    /// A `//!` line that is not `//!import name`.
    #[error(
        "{file}:{line}: unknown directive `{directive}`; write `//!import name`, or `//` for a comment"
    )]
    Directive {
        /// File the line is in.
        file: String,
        /// Line, from 1.
        line: u32,
        /// The line as it stands.
        directive: String,
    },
    /// An import below other text.
    #[error(
        "{file}:{line}: imports come first in a file, before comments and code; move this line up"
    )]
    LateImport {
        /// File the line is in.
        file: String,
        /// Line, from 1.
        line: u32,
    },
    /// An import of a file that does not exist.
    #[error("{file}:{line}: there is no shared file `{name}`; there are: {known}")]
    UnknownImport {
        /// File the import is in.
        file: String,
        /// Line, from 1.
        line: u32,
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// Shared files that import one another.
    #[error(
        "{file}:{line}: this import closes a cycle: {chain}; move what both need into a third shared file"
    )]
    ImportCycle {
        /// File the import is in.
        file: String,
        /// Line, from 1.
        line: u32,
        /// `a -> b -> a`.
        chain: String,
    },
    /// What naga has to say, with the original files and lines.
    #[error("{report}")]
    Invalid {
        /// The rendered report.
        report: String,
        /// File of the first place named, if naga named one.
        file: Option<String>,
        /// Its line, from 1.
        line: Option<u32>,
    },
    /// Nothing to start a pipeline at.
    #[error(
        "{file}: no entry point; text that others import belongs into `shared`, a job needs @vertex, @fragment or @compute"
    )]
    NoEntryPoint {
        /// The job's file.
        file: String,
    },
    /// Two variables at one place.
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
        /// Variable's name.
        first: String,
        /// Variable's name.
        second: String,
    },
    /// A group number beyond what wgpu has.
    #[error(
        "{file}: `{variable}` is in @group({group}), but wgpu has groups 0 to {last}; use a lower number"
    )]
    GroupNumber {
        /// The job's file.
        file: String,
        /// The variable's name.
        variable: String,
        /// The group it asks for.
        group: u32,
        /// The highest group number there is.
        last: u32,
    },
    /// A resource that no bind group layout can hold.
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
