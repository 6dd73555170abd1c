//! Declares copy nodes: transfers on the command encoder.

use crate::access::Access;
use crate::builder::common_builder;
use crate::graph::Graph;
use crate::handle::{Buffer, Handle, Texture};
use crate::pass::PassKind;

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

impl Graph {
    /// A node that copies. Its body gets the command encoder.
    pub fn copy(&mut self, name: impl Into<String>) -> CopyBuilder<'_> {
        let pass = self.begin(name.into(), PassKind::Copy);
        CopyBuilder::new(self, pass)
    }
}

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
