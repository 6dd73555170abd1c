//! Copy nodes: transfers on the command encoder.

use crate::access::Access;
use crate::builder::{common_builder, common_context};
use crate::frame::PassView;
use crate::handle::Handle;
use crate::{Buffer, Graph, Texture};

/// What can be copied: a [`Texture`] or a [`Buffer`].
pub trait Copyable: Handle {}

impl Copyable for Texture {}
impl Copyable for Buffer {}

/// Declares a copy node. Methods that write return the next version; the others return the builder.
pub struct CopyBuilder<'g> {
    graph: &'g mut Graph,
    pass: usize,
}

common_builder!(CopyBuilder, CopyContext, Copy);

impl CopyBuilder<'_> {
    /// Copies from the texture or buffer.
    pub fn copy_src(&mut self, handle: impl Copyable) -> &mut Self {
        self.graph.read(self.pass, handle, Access::CopySrc);
        self
    }

    /// Copies into (or clears) the texture or buffer.
    pub fn copy_dst<H: Copyable>(&mut self, handle: H) -> H {
        self.graph.write(self.pass, handle, Access::CopyDst)
    }
}

/// What the body of a copy node works with.
pub struct CopyContext<'a> {
    pub(crate) view: PassView<'a>,
    pub(crate) encoder: &'a mut wgpu::CommandEncoder,
}

common_context!(CopyContext);

impl CopyContext<'_> {
    /// The encoder the frame is recorded with. Leave no pass open on it.
    pub fn encoder(&mut self) -> &mut wgpu::CommandEncoder {
        self.encoder
    }
}
