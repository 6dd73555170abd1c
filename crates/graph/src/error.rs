//! Errors of compiling, of bodies that access resources, and of frames. Each message says what is wrong, where, and what to do about it.

use std::error::Error;
use std::fmt;

use thiserror::Error;

/// Everything that is wrong with a graph, in the order it was found.
#[derive(Debug, Error)]
pub struct CompileErrors {
    /// The graph's name.
    pub graph: String,
    /// At least one error.
    pub errors: Vec<CompileError>,
}

impl fmt::Display for CompileErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "graph `{}` cannot be compiled:", self.graph)?;
        for error in &self.errors {
            write!(f, "\n  - {error}")?;
        }
        Ok(())
    }
}

/// One thing that is wrong with a graph.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CompileError {
    /// Passes depend on each other in a cycle.
    #[error("a cycle: {}; each waits for the one before it. Read another version, or drop an `after`", .passes.join(" -> "))]
    Cycle {
        /// The passes in order; the first depends on the last.
        passes: Vec<String>,
    },
    /// A version is read that no pass writes.
    #[error(
        "pass `{pass}` reads `{resource}` (version {version}), which nothing has written; read the handle a write returned"
    )]
    ReadBeforeWrite {
        /// The reader.
        pass: String,
        /// The resource.
        resource: String,
        /// The version that is read.
        version: u32,
    },
    /// Two passes write the same version and nothing orders them.
    #[error(
        "passes `{first}` and `{second}` both write version {version} of `{resource}` without an order; write the handle the other returned, or say `after`"
    )]
    TwoWriters {
        /// The pass declared first.
        first: String,
        /// The pass declared second.
        second: String,
        /// The resource.
        resource: String,
        /// The version both start from.
        version: u32,
    },
    /// A format does not allow the declared use.
    #[error(
        "pass `{pass}` uses `{resource}` as {access}, which {format:?} does not allow on this device"
    )]
    Usage {
        /// The pass.
        pass: String,
        /// The texture.
        resource: String,
        /// The declared use.
        access: &'static str,
        /// Its format.
        format: wgpu::TextureFormat,
    },
    /// A format does not have the sample count on this device.
    #[error(
        "`{resource}` asks for {samples} samples of {format:?}; this device allows {allowed:?}"
    )]
    SampleCount {
        /// The texture.
        resource: String,
        /// The declared sample count.
        samples: u32,
        /// Its format.
        format: wgpu::TextureFormat,
        /// The allowed sample counts.
        allowed: Vec<u32>,
    },
    /// The device was created without a feature.
    #[error(
        "{item} needs the device feature {feature}, which this device was not made with; request it, or leave the pass out"
    )]
    MissingFeature {
        /// The pass or texture, with its kind.
        item: String,
        /// The missing features, by name.
        feature: String,
    },
    /// The adapter lacks a downlevel capability.
    #[error(
        "pass `{pass}` needs {capability}, which this adapter lacks; use another adapter, or leave the pass out"
    )]
    MissingCapability {
        /// The pass.
        pass: String,
        /// The downlevel flag.
        capability: String,
    },
    /// A pass samples one mip of a texture and writes another as a storage texture. On OpenGL the write would be lost.
    #[error(
        "pass `{pass}` samples one mip of `{resource}` and writes another, which OpenGL cannot do; read the mip with `storage_texture_read`"
    )]
    SampledBesideWrite {
        /// The pass.
        pass: String,
        /// The texture.
        resource: String,
    },
    /// Something is larger than the device allows.
    #[error("`{resource}` asks for {asked} {what}; this device allows {limit}")]
    Limit {
        /// The resource or pass.
        resource: String,
        /// What is too large.
        what: &'static str,
        /// The declared amount.
        asked: u64,
        /// The device's limit.
        limit: u64,
    },
    /// A description that no resource can have.
    #[error("`{resource}` {what}")]
    BadDescription {
        /// The resource.
        resource: String,
        /// What is wrong with it, and what to do.
        what: &'static str,
    },
    /// Attachments of one raster pass differ in size or sample count.
    #[error(
        "pass `{pass}` draws into `{first}` ({first_shape}) and `{second}` ({second_shape}) at once; sizes and sample counts must agree"
    )]
    AttachmentMismatch {
        /// The pass.
        pass: String,
        /// One attachment.
        first: String,
        /// Its width, height and samples.
        first_shape: String,
        /// The other.
        second: String,
        /// Its width, height and samples.
        second_shape: String,
    },
    /// A raster pass has no attachment.
    #[error("raster pass `{pass}` has no attachment; give it `colour`, `depth` or `depth_read`")]
    NoAttachment {
        /// The pass.
        pass: String,
    },
    /// The texture does not have the mip or layer.
    #[error(
        "pass `{pass}` draws into mip {mip}, layer {layer} of `{resource}`, which has {mips} mips and {layers} layers"
    )]
    NoSuchSubresource {
        /// The pass.
        pass: String,
        /// The texture.
        resource: String,
        /// The declared mip.
        mip: u32,
        /// The declared layer.
        layer: u32,
        /// Mips of the texture.
        mips: u32,
        /// Layers of the texture.
        layers: u32,
    },
    /// A handle belongs to another graph.
    #[error(
        "pass `{pass}` names a resource or a pass of another graph; handles are good only in the graph that made them"
    )]
    ForeignHandle {
        /// The pass.
        pass: String,
    },
    /// A node was begun and not finished.
    #[error("pass `{pass}` has no body; finish it with `run`")]
    NoBody {
        /// The pass.
        pass: String,
    },
    /// A node was finished twice.
    #[error("pass `{pass}` was given two bodies; call `run` once")]
    TwoBodies {
        /// The pass.
        pass: String,
    },
    /// wgpu does not allow two uses within one pass.
    #[error(
        "pass `{pass}` uses `{resource}` as {first} and as {second} at once; split the pass in two"
    )]
    Conflict {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
        /// One use.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// A previous value is written.
    #[error(
        "pass `{pass}` writes the previous value of `{resource}`; write the current one, or use `updates`"
    )]
    WritesPrevious {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
    },
    /// The previous value of an import is read. The graph keeps no history of imports.
    #[error(
        "pass `{pass}` looks back at `{resource}`, which is imported; keep its history outside and import that as well"
    )]
    PreviousOfImport {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
    },
    /// An update is not the first write, or not the only update.
    #[error("pass `{pass}` updates `{resource}`, but {why}")]
    BadUpdate {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
        /// The reason, and what to do.
        why: String,
    },
    /// A later pass overwrites an output.
    #[error(
        "`{resource}` is an output at version {version}, but pass `{pass}` writes it later; make the last version the output"
    )]
    OutputOverwritten {
        /// The resource.
        resource: String,
        /// The version named as output.
        version: u32,
        /// The pass that overwrites it.
        pass: String,
    },
    /// A plan that records into the caller's encoder cannot wait.
    #[error(
        "pass `{pass}` reads `{resource}` back within the frame, a sync point; an embedded plan cannot wait. Use `read_previous`, or run the plan on its own"
    )]
    SyncInEmbedded {
        /// The host node.
        pass: String,
        /// What it reads back.
        resource: String,
    },
    /// A browser cannot wait.
    #[error(
        "pass `{pass}` reads `{resource}` back within the frame, a sync point; a browser cannot wait for the GPU. Use `read_previous`, or a strategy's frame-late or on-gpu form"
    )]
    SyncInBrowser {
        /// The host node.
        pass: String,
        /// What it reads back.
        resource: String,
    },
    /// A plan that records into the caller's encoder cannot loop.
    #[error(
        "host loop `{pass}` cannot run in an embedded plan; run the plan on its own, or use a frame-late form"
    )]
    LoopInEmbedded {
        /// The loop.
        pass: String,
    },
    /// No node of a loop writes its condition.
    #[error(
        "host loop `{pass}` ends when `{resource}` is true, but no node of the loop writes it; return the handle written inside"
    )]
    LoopCondition {
        /// The loop.
        pass: String,
        /// The condition.
        resource: String,
    },
    /// The device could not create a texture, a buffer or a query set, most likely because memory ran out.
    #[error("the device could not make the plan's resources: {message}")]
    Device {
        /// wgpu's message.
        message: String,
    },
}

/// A body accessed a resource that it did not declare, or in a way that cannot work.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum AccessError {
    /// The pass did not declare the use.
    #[error(
        "pass `{pass}` did not declare that it {verb} `{resource}`; declare it when building the pass"
    )]
    Undeclared {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
        /// What the body tried.
        verb: &'static str,
    },
    /// A handle of another graph.
    #[error("pass `{pass}` used a handle of another graph")]
    Foreign {
        /// The pass.
        pass: String,
    },
    /// The value is read while it is written, or the reverse.
    #[error(
        "pass `{pass}` already holds `{resource}` in a way that excludes this; drop the other borrow first"
    )]
    Borrowed {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
    },
    /// The resource holds no value.
    #[error("pass `{pass}` finds no value in `{resource}`")]
    Empty {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
    },
    /// A range is outside of its buffer or not a multiple of 4 bytes.
    #[error(
        "pass `{pass}`: bytes {offset}..{end} do not fit `{resource}` of {size} bytes (offset and length must be multiples of 4)"
    )]
    Range {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
        /// First byte.
        offset: u64,
        /// One past the last byte.
        end: u64,
        /// The buffer's size.
        size: u64,
    },
    /// The texture does not have the mip level.
    #[error("pass `{pass}` asked for mip {mip} of `{resource}`, which has {mips}")]
    Mip {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
        /// The mip that the body asked for.
        mip: u32,
        /// Mips of the texture.
        mips: u32,
    },
    /// An occlusion query is out of order. They must be issued in ascending order without gaps, within the range of this run.
    #[error(
        "pass `{pass}` issued query {query} where {expected} was due (this run takes up to {end}); issue `query_range()` in ascending order without holes"
    )]
    QueryOrder {
        /// The pass.
        pass: String,
        /// The query that was issued.
        query: u32,
        /// The query that was due.
        expected: u32,
        /// One past the last query of this run.
        end: u32,
    },
}

/// The error of a body: any error type, converted by `?`.
pub struct BodyError(Box<dyn Error + Send + Sync>);

impl BodyError {
    /// An error from a message.
    pub fn msg(message: impl Into<String>) -> Self {
        Self(message.into().into())
    }

    /// The error that it holds.
    #[must_use]
    pub fn into_inner(self) -> Box<dyn Error + Send + Sync> {
        self.0
    }
}

impl<E: Error + Send + Sync + 'static> From<E> for BodyError {
    fn from(error: E) -> Self {
        Self(Box::new(error))
    }
}

impl fmt::Debug for BodyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.0, f)
    }
}

impl fmt::Display for BodyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.0, f)
    }
}

/// Why a frame could not be finished. Nothing of it was submitted after the point of failure, and histories start anew with the next
/// frame. With an embedded plan, drop the encoder.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExecuteError {
    /// `execute` was called on an embedded plan, or `record` on an owned one.
    #[error("this plan was compiled for {compiled}; call {call}")]
    WrongMode {
        /// What the plan was compiled for.
        compiled: &'static str,
        /// The function to call.
        call: &'static str,
    },
    /// An imported host value was not set this frame.
    #[error("host value `{resource}` was not set; call `Plan::set` before each frame")]
    Unset {
        /// The resource.
        resource: String,
    },
    /// An imported texture or buffer is not bound.
    #[error(
        "`{resource}` is not bound; call `Plan::bind_texture` or `Plan::bind_buffer` before the frame"
    )]
    Unbound {
        /// The resource.
        resource: String,
    },
    /// A bound object does not fit the declaration.
    #[error("what was bound to `{resource}` does not fit its declaration: {why}")]
    BadBinding {
        /// The resource.
        resource: String,
        /// What differs.
        why: String,
    },
    /// A handle belongs to another graph or is no import.
    #[error("`{call}` was given a handle that is no import of graph `{graph}`")]
    NoImport {
        /// The function that was called.
        call: &'static str,
        /// The graph.
        graph: String,
    },
    /// A body failed.
    #[error("pass `{pass}` failed")]
    Body {
        /// The pass.
        pass: String,
        /// Its error.
        #[source]
        source: Box<dyn Error + Send + Sync>,
    },
    /// A loop did not end.
    #[error(
        "host loop `{pass}` did not end within {limit} iterations; raise its limit or correct its condition"
    )]
    LoopLimit {
        /// The loop.
        pass: String,
        /// Iterations that were run.
        limit: u32,
    },
    /// A pass asks for more queries than their buffer holds.
    #[error("pass `{pass}` asks for {count} queries; `{resource}` holds {capacity} (8 bytes each)")]
    TooManyQueries {
        /// The pass.
        pass: String,
        /// The buffer.
        resource: String,
        /// The number of queries.
        count: u32,
        /// Queries that the buffer holds.
        capacity: u32,
    },
    /// The device was lost.
    #[error("the device was lost while {what}; make a new device and compile the graph again")]
    DeviceLost {
        /// What was being done.
        what: String,
    },
    /// The backend cannot wait for the GPU (browsers).
    #[error(
        "sync point of `{pass}`: this backend cannot wait for the GPU; use a frame-late or an on-gpu strategy"
    )]
    CannotWait {
        /// The first host node of the sync point.
        pass: String,
    },
}
