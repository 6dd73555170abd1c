//! A compute pipeline made from one of the shaders, and how it is dispatched.

use antumbra_graph::{Bind, BodyError, ComputeContext};
use antumbra_shaders::Job;

use crate::device::Gpu;

/// A compute pipeline of one bind group. Two are equal that are the same on a device.
#[derive(Debug, Clone, PartialEq)]
pub struct ComputePipeline {
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

impl ComputePipeline {
    /// The pipeline of an entry point of a shader, compiled once a device. It is bound to what this entry point uses, so that others of the same shader may have bindings of their own.
    pub fn new(gpu: &Gpu, job: &Job, entry: &'static str) -> Self {
        gpu.compute_pipeline(job, entry).as_ref().clone()
    }

    pub(crate) fn compile(gpu: &Gpu, job: &Job, entry: &'static str) -> Self {
        let entries: Vec<_> = job
            .bindings
            .iter()
            .filter(|binding| binding.group == 0)
            .filter(|binding| binding.uses.iter().any(|used| used.entry_point == entry))
            .map(|binding| binding.entry)
            .collect();
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(job.name.as_ref()),
                entries: &entries,
            });
        let pipeline_layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(job.name.as_ref()),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
        let pipeline = gpu
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(job.name.as_ref()),
                layout: Some(&pipeline_layout),
                module: &gpu.shader_module(job),
                entry_point: Some(entry),
                compilation_options: Default::default(),
                cache: None,
            });
        Self { pipeline, layout }
    }

    /// Dispatches `wide` x `rows` workgroups with these bindings.
    ///
    /// # Errors
    /// [`BodyError`] for a binding that the node has not declared.
    pub fn dispatch(
        &self,
        ctx: &mut ComputeContext<'_>,
        binds: &[Bind],
        [wide, rows]: [u32; 2],
    ) -> Result<(), BodyError> {
        self.dispatch_layers(ctx, binds, [wide, rows, 1])
    }

    /// The same, in so many layers.
    pub(crate) fn dispatch_layers(
        &self,
        ctx: &mut ComputeContext<'_>,
        binds: &[Bind],
        [wide, rows, layers]: [u32; 3],
    ) -> Result<(), BodyError> {
        let group = ctx.bind_group(0, &self.layout, binds)?;
        let pass = ctx.pass();
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(wide, rows, layers);
        Ok(())
    }

    /// The bind group of these buffers, numbered from 0, for a pass outside of the graph.
    pub(crate) fn group(&self, gpu: &Gpu, buffers: &[&wgpu::Buffer]) -> wgpu::BindGroup {
        let entries: Vec<_> = buffers
            .iter()
            .zip(0u32..)
            .map(|(buffer, binding)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.layout,
            entries: &entries,
        })
    }

    /// The bind group of these resources by binding, for a pass outside of the graph.
    pub(crate) fn group_of(
        &self,
        gpu: &Gpu,
        resources: &[(u32, wgpu::BindingResource<'_>)],
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = resources
            .iter()
            .map(|(binding, resource)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: resource.clone(),
            })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.layout,
            entries: &entries,
        })
    }

    /// As [`Self::dispatch_layers`], in a pass outside of the graph.
    pub(crate) fn dispatch_in(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        group: &wgpu::BindGroup,
        [wide, rows, layers]: [u32; 3],
    ) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.dispatch_workgroups(wide, rows, layers);
    }
}

/// The most workgroups in a dimension of a dispatch: WebGPU's default limit.
const MOST_WORKGROUPS: u32 = 65_535;

/// Workgroups in rows, as [`ComputePipeline::dispatch`] takes them: a dispatch may have at most 65,535 along a dimension. The last row may have some too many: a shader goes by the number
/// of workgroups in a row and returns where nothing is left.
pub fn rows_of(groups: u32) -> [u32; 2] {
    let wide = groups.clamp(1, MOST_WORKGROUPS);
    [wide, groups.div_ceil(wide)]
}

#[cfg(test)]
mod tests {
    use super::rows_of;

    #[test]
    fn rows_hold_all_workgroups_and_no_row_is_too_wide() {
        for groups in [0, 1, 64, 65_535, 65_536, 1 << 20, u32::MAX] {
            let [wide, rows] = rows_of(groups);
            assert!(
                wide <= 65_535 && rows <= 65_538,
                "{groups}: {wide} x {rows}"
            );
            assert!(u64::from(wide) * u64::from(rows) >= u64::from(groups));
        }
    }
}
