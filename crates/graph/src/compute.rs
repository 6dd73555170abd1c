//! Declares compute nodes: one compute pass with shader accesses.

use crate::builder::{common_builder, shader_builder};
use crate::graph::Graph;
use crate::pass::PassKind;

/// Declares a compute node. Methods that write return the next version; the others return the builder.
pub struct ComputeBuilder<'g> {
    graph: &'g mut Graph,
    pass: usize,
}

common_builder!(ComputeBuilder, ComputeContext, Compute);
shader_builder!(ComputeBuilder);

impl Graph {
    /// A node that computes: one compute pass.
    pub fn compute(&mut self, name: impl Into<String>) -> ComputeBuilder<'_> {
        let pass = self.begin(name.into(), PassKind::Compute);
        ComputeBuilder::new(self, pass)
    }
}
