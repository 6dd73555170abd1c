//! What can go wrong, when declaring, when a body reaches for a resource, and in a frame. Each case says what, where, and what to do.

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
    /// Passes that wait for each other.
    #[error("a cycle: {}; each waits for the one before it. Read another version, or drop an `after`", .passes.join(" -> "))]
    Cycle {
        /// The passes in order; the last waits for the first.
        passes: Vec<String>,
    },
    /// A version nobody writes.
    #[error(
        "pass `{pass}` reads `{resource}` (version {version}), which nothing has written; read the handle a write returned"
    )]
    ReadBeforeWrite {
        /// The reader.
        pass: String,
        /// The resource.
        resource: String,
        /// The version asked for.
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
    /// A format that cannot be used in the way declared.
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
    /// A sample count the format does not have here.
    #[error(
        "`{resource}` asks for {samples} samples of {format:?}; this device allows {allowed:?}"
    )]
    SampleCount {
        /// The texture.
        resource: String,
        /// Samples asked for.
        samples: u32,
        /// Its format.
        format: wgpu::TextureFormat,
        /// What is allowed.
        allowed: Vec<u32>,
    },
    /// A feature the device was not made with.
    #[error(
        "{who} needs the device feature {feature}, which this device was not made with; request it, or leave the pass out"
    )]
    MissingFeature {
        /// The pass or resource, with its kind.
        who: String,
        /// The feature or features.
        feature: String,
    },
    /// Something the adapter's class cannot do at all.
    #[error(
        "pass `{pass}` needs {capability}, which this adapter lacks; use another adapter, or leave the pass out"
    )]
    MissingCapability {
        /// The pass.
        pass: String,
        /// The downlevel flag.
        capability: String,
    },
    /// Larger than the device allows.
    #[error("`{resource}` asks for {asked} {what}; this device allows {limit}")]
    Limit {
        /// The resource or pass.
        resource: String,
        /// What is too large.
        what: &'static str,
        /// How much was asked for.
        asked: u64,
        /// How much there is.
        limit: u64,
    },
    /// A description that describes nothing.
    #[error("`{resource}` {what}")]
    BadDescription {
        /// The resource.
        resource: String,
        /// What is wrong with it, and what to do.
        what: &'static str,
    },
    /// Attachments of one raster pass that do not fit together.
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
    /// A raster pass without a target.
    #[error("raster pass `{pass}` has no attachment; give it `colour`, `depth` or `depth_read`")]
    NoAttachment {
        /// The pass.
        pass: String,
    },
    /// A mip or layer the texture does not have, or a mip of a resolve.
    #[error(
        "pass `{pass}` draws into mip {mip}, layer {layer} of `{resource}`, which has {mips} mips and {layers} layers"
    )]
    NoSuchSubresource {
        /// The pass.
        pass: String,
        /// The texture.
        resource: String,
        /// Mip asked for.
        mip: u32,
        /// Layer asked for.
        layer: u32,
        /// Mips there are.
        mips: u32,
        /// Layers there are.
        layers: u32,
    },
    /// A handle made by another graph.
    #[error(
        "pass `{pass}` names a resource or a pass of another graph; handles are good only in the graph that made them"
    )]
    ForeignHandle {
        /// The pass.
        pass: String,
    },
    /// A node that was begun and not finished.
    #[error("pass `{pass}` has no body; finish it with `run`")]
    NoBody {
        /// The pass.
        pass: String,
    },
    /// A node finished twice.
    #[error("pass `{pass}` was given two bodies; call `run` once")]
    TwoBodies {
        /// The pass.
        pass: String,
    },
    /// Two uses within one pass that wgpu does not allow together.
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
    /// Last frame's value cannot be written.
    #[error(
        "pass `{pass}` writes the previous value of `{resource}`; write the current one, or use `updates`"
    )]
    WritesPrevious {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
    },
    /// The graph keeps no history of what it does not own.
    #[error(
        "pass `{pass}` looks back at `{resource}`, which is imported; keep its history outside and import that as well"
    )]
    PreviousOfImport {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
    },
    /// An update that is not the first and only one.
    #[error("pass `{pass}` updates `{resource}`, but {why}")]
    BadUpdate {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
        /// What is in the way, and what to do.
        why: String,
    },
    /// An output that a later pass overwrites.
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
    /// A plan recorded into somebody else's frame cannot wait.
    #[error(
        "pass `{pass}` reads `{resource}` back within the frame, a sync point; an embedded plan cannot wait. Use `read_previous`, or run the plan on its own"
    )]
    SyncInEmbedded {
        /// The host node.
        pass: String,
        /// What it reads back.
        resource: String,
    },
    /// A plan recorded into somebody else's frame cannot loop.
    #[error(
        "host loop `{pass}` cannot run in an embedded plan; run the plan on its own, or use a frame-late form"
    )]
    LoopInEmbedded {
        /// The loop.
        pass: String,
    },
    /// A loop whose condition nothing in it decides.
    #[error(
        "host loop `{pass}` ends when `{resource}` is true, but no node of the loop writes it; return the handle written inside"
    )]
    LoopCondition {
        /// The loop.
        pass: String,
        /// The condition.
        resource: String,
    },
    /// The device refused to make a texture, a buffer or a query set, most likely for want of memory.
    #[error("the device could not make the plan's resources: {message}")]
    Device {
        /// wgpu's words.
        message: String,
    },
}

/// A body reached for something it did not declare, or in a way that cannot work.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum AccessError {
    /// Not declared by this pass.
    #[error(
        "pass `{pass}` did not declare that it {verb} `{resource}`; declare it when building the pass"
    )]
    Undeclared {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
        /// What it tried, in words.
        verb: &'static str,
    },
    /// A handle of another graph.
    #[error("pass `{pass}` used a handle of another graph")]
    Foreign {
        /// The pass.
        pass: String,
    },
    /// Read while being written, or the reverse.
    #[error(
        "pass `{pass}` already holds `{resource}` in a way that excludes this; drop the other borrow first"
    )]
    Borrowed {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
    },
    /// Nothing is there.
    #[error("pass `{pass}` finds no value in `{resource}`")]
    Empty {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
    },
    /// A range outside of a buffer, or one that is not a multiple of 4 bytes.
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
    /// A mip level the texture does not have.
    #[error("pass `{pass}` asked for mip {mip} of `{resource}`, which has {mips}")]
    Mip {
        /// The pass.
        pass: String,
        /// The resource.
        resource: String,
        /// The mip asked for.
        mip: u32,
        /// How many there are.
        mips: u32,
    },
    /// Occlusion queries must be issued in order, without holes, within the range of this run.
    #[error(
        "pass `{pass}` issued query {query} where {expected} was due (this run takes up to {end}); issue `query_range()` in ascending order without holes"
    )]
    QueryOrder {
        /// The pass.
        pass: String,
        /// The query issued.
        query: u32,
        /// The query due.
        expected: u32,
        /// One past the last query of this run.
        end: u32,
    },
}

/// What a body may fail with: any error. `?` converts.
pub struct BodyError(Box<dyn Error + Send + Sync>);

impl BodyError {
    /// An error that is only words.
    pub fn msg(message: impl Into<String>) -> Self {
        Self(message.into().into())
    }

    /// The error inside.
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

/// A frame that could not be finished. Nothing of it was submitted after the point of failure;
/// history starts anew with the next frame. In an embedded plan, drop the encoder.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExecuteError {
    /// `execute` on an embedded plan or `record` on an owned one.
    #[error("this plan was compiled for {compiled}; call {call}")]
    WrongMode {
        /// What it was compiled for.
        compiled: &'static str,
        /// What to call.
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
    /// What was bound does not fit the declaration.
    #[error("what was bound to `{resource}` does not fit its declaration: {why}")]
    BadBinding {
        /// The resource.
        resource: String,
        /// What differs.
        why: String,
    },
    /// A handle of another graph, or one that is no import.
    #[error("`{call}` was given a handle that is no import of graph `{graph}`")]
    NoImport {
        /// The call.
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
    /// A loop that does not end.
    #[error(
        "host loop `{pass}` did not end within {limit} turns; raise its limit or correct its condition"
    )]
    LoopLimit {
        /// The loop.
        pass: String,
        /// Turns taken.
        limit: u32,
    },
    /// More queries than their buffer holds.
    #[error("pass `{pass}` asks for {count} queries; `{resource}` holds {capacity} (8 bytes each)")]
    TooManyQueries {
        /// The pass.
        pass: String,
        /// The buffer.
        resource: String,
        /// Queries asked for.
        count: u32,
        /// Queries there is room for.
        capacity: u32,
    },
    /// The device is gone.
    #[error("the device was lost while {what}; make a new device and compile the graph again")]
    DeviceLost {
        /// What was under way.
        what: String,
    },
    /// This backend cannot block (browsers).
    #[error(
        "sync point of `{pass}`: this backend cannot wait for the GPU; use a frame-late or an on-gpu strategy"
    )]
    CannotWait {
        /// The first host node of the sync point.
        pass: String,
    },
}
