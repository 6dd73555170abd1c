//! Compute nodes: one compute pass with shader accesses.

use crate::Graph;
use crate::builder::{common_builder, common_context, shader_builder};
use crate::frame::PassView;

/// Declares a compute node. Methods that write return the next version; the others return the builder.
pub struct ComputeBuilder<'g> {
    graph: &'g mut Graph,
    pass: usize,
}

common_builder!(ComputeBuilder, ComputeContext, Compute);
shader_builder!(ComputeBuilder);

/// What the body of a compute node works with.
pub struct ComputeContext<'a> {
    pub(crate) view: PassView<'a>,
    pub(crate) pass: wgpu::ComputePass<'static>,
}

common_context!(ComputeContext);

impl ComputeContext<'_> {
    /// The compute pass, open.
    pub fn pass(&mut self) -> &mut wgpu::ComputePass<'static> {
        &mut self.pass
    }
}
