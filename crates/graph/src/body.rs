//! The bodies of passes: closures that record or run them.

use crate::context::{ComputeContext, CopyContext, HostContext, RasterContext};
use crate::error::BodyError;

pub(crate) type RasterBody = Box<dyn FnMut(&mut RasterContext<'_>) -> Result<(), BodyError> + Send>;
pub(crate) type ComputeBody =
    Box<dyn FnMut(&mut ComputeContext<'_>) -> Result<(), BodyError> + Send>;
pub(crate) type CopyBody = Box<dyn FnMut(&mut CopyContext<'_>) -> Result<(), BodyError> + Send>;
pub(crate) type HostBody = Box<dyn FnMut(&mut HostContext<'_>) -> Result<(), BodyError> + Send>;

/// A pass's body, by the kind of the pass.
pub(crate) enum Body {
    /// Not given yet, or a loop: its nodes have the bodies.
    None,
    Raster(RasterBody),
    Compute(ComputeBody),
    Copy(CopyBody),
    Host(HostBody),
}
