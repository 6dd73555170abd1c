//! Compute nodes: one compute pass with shader accesses.

use crate::Graph;
use crate::builder::{common_builder, common_context, shader_builder};
use crate::frame::PassView;
use crate::host::HostReader;

/// Declares a compute node. Methods that write return the next version; the others return the builder.
pub struct ComputeBuilder<'g> {
    graph: &'g mut Graph,
    pass: usize,
}

common_builder!(ComputeBuilder, ComputeContext, Compute);
shader_builder!(ComputeBuilder);

impl ComputeBuilder<'_> {
    /// Leaves the pass out of the frames, and of the turns of a loop, in which `condition` is false. What it would have written keeps what it holds; a buffer
    /// that is zeroed each frame is zeroed all the same. The function may read the host values this node declares.
    pub fn only_if(
        &mut self,
        condition: impl Fn(&HostReader<'_>) -> bool + Send + 'static,
    ) -> &mut Self {
        self.declared().condition = Some(Box::new(condition));
        self
    }
}

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
