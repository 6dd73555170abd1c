//! A pass as declared: its kind, its uses, and what it asks of the executor. Its body is kept apart ([`crate::body`]).

use std::collections::BTreeMap;

use crate::access::Use;
use crate::frame::{HostReader, PassView};
use crate::handle::{PassId, Raw};

/// Returns how many bytes a frame reads back.
pub(crate) type BytesFn = Box<dyn Fn(&HostReader<'_>) -> u64 + Send>;
/// Returns whether the pass runs in a frame.
pub(crate) type ConditionFn = Box<dyn Fn(&HostReader<'_>) -> bool + Send>;
/// Returns how many queries a frame issues.
pub(crate) type CountFn = Box<dyn Fn(&HostReader<'_>) -> u32 + Send>;

/// The kind of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "json",
    derive(serde::Serialize),
    serde(rename_all = "snake_case")
)]
pub enum PassKind {
    /// One render pass, or several where queries exceed a set.
    Raster,
    /// One compute pass.
    Compute,
    /// Copies on the encoder.
    Copy,
    /// A step on the host.
    Host,
    /// A sub-graph that runs until its condition is true.
    HostLoop,
}

impl PassKind {
    /// Its name in exported graphs.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Raster => "raster",
            Self::Compute => "compute",
            Self::Copy => "copy",
            Self::Host => "host",
            Self::HostLoop => "host loop",
        }
    }
}

/// The part of the target that a raster pass draws to, in texels; depth 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Viewport {
    pub x: f32,
    pub y: f32,
    pub width: f32,
    pub height: f32,
}

/// A loop's condition and limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoopDecl {
    pub condition: Raw,
    /// Iterations after which the frame fails.
    pub limit: u32,
}

/// A pass as declared.
pub(crate) struct Pass {
    pub name: String,
    pub kind: PassKind,
    /// The loop that contains it.
    pub parent: Option<usize>,
    pub uses: Vec<Use>,
    /// By index into `uses`: how much of a read-back is wanted, where that is limited.
    pub byte_limits: BTreeMap<usize, BytesFn>,
    pub after: Vec<PassId>,
    pub group: Option<&'static str>,
    pub side_effect: bool,
    pub requires: wgpu::Features,
    pub viewport: Option<Viewport>,
    pub query_count: Option<CountFn>,
    pub condition: Option<ConditionFn>,
    pub looped: Option<LoopDecl>,
}

impl Pass {
    /// Whether its condition says that it does nothing this time.
    pub fn is_idle(&self, view: PassView<'_>) -> bool {
        let condition = self.condition.as_ref();
        condition.is_some_and(|condition| !condition(&HostReader { view }))
    }

    /// Bytes wanted of the read-back `uses[used]`; `u64::MAX` where they are not limited.
    pub fn wanted_bytes(&self, used: usize, view: PassView<'_>) -> u64 {
        let limit = self.byte_limits.get(&used);
        limit.map_or(u64::MAX, |limit| limit(&HostReader { view }))
    }
}
