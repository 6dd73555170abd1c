//! A pass as declared: its kind, its uses, its wishes and its body.

use crate::access::{ConditionFn, CountFn, Use};
use crate::compute::ComputeContext;
use crate::copy::CopyContext;
use crate::error::BodyError;
use crate::handle::{PassId, Raw};
use crate::host::HostContext;
use crate::raster::RasterContext;

pub(crate) type RasterBody = Box<dyn FnMut(&mut RasterContext<'_>) -> Result<(), BodyError> + Send>;
pub(crate) type ComputeBody =
    Box<dyn FnMut(&mut ComputeContext<'_>) -> Result<(), BodyError> + Send>;
pub(crate) type CopyBody = Box<dyn FnMut(&mut CopyContext<'_>) -> Result<(), BodyError> + Send>;
pub(crate) type HostBody = Box<dyn FnMut(&mut HostContext<'_>) -> Result<(), BodyError> + Send>;

pub(crate) enum Body {
    /// Not given yet, or a loop: its nodes have the bodies.
    None,
    Raster(RasterBody),
    Compute(ComputeBody),
    Copy(CopyBody),
    Host(HostBody),
}

/// What a pass is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PassKind {
    /// One render pass, or several where queries exceed a set.
    Raster,
    /// One compute pass.
    Compute,
    /// Copies on the encoder.
    Copy,
    /// A step on the host.
    Host,
    /// A sub-graph run until its condition is true.
    HostLoop,
}

impl PassKind {
    /// The word for pictures.
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

/// The part of the target a raster pass draws to, in texels; depth 0 to 1.
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
    pub limit: u32,
}

pub(crate) struct Pass {
    pub name: String,
    pub kind: PassKind,
    /// The loop it is part of.
    pub parent: Option<usize>,
    pub uses: Vec<Use>,
    pub after: Vec<PassId>,
    pub group: Option<&'static str>,
    pub side_effect: bool,
    pub requires: wgpu::Features,
    pub viewport: Option<Viewport>,
    pub query_count: Option<CountFn>,
    /// Whether a frame has anything to do in it.
    pub condition: Option<ConditionFn>,
    pub looped: Option<LoopDecl>,
}
