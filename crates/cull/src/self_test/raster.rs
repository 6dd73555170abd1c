//! How trials draw rectangles: pipelines of the shaders that renderers use, buffers, and passes over them.

use antumbra_shaders::{Job, jobs};

use super::bench::Bench;
use super::picture::{CLIP_FROM_RELATIVE, EYE, GpuInstance, Rect};
use crate::device::Gpu;
use crate::renderer::{DEPTH_FORMAT, IDENTITY_FORMAT};
use crate::view::GpuView;

/// What a pipeline does with the depth buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum DepthUse {
    /// Tests and writes it.
    Writes,
    /// Tests it.
    Tests,
    /// Has it because a pass needs an attachment.
    Ignores,
}

/// A pipeline to make.
pub(super) struct RasterDesc {
    pub job: &'static Job,
    pub vertex: &'static str,
    pub fragment: Option<&'static str>,
    pub depth: DepthUse,
    /// Whether it writes ids.
    pub ids: bool,
    pub samples: u32,
    /// The samples of a pixel that it writes.
    pub mask: u64,
}

impl RasterDesc {
    /// Depth alone, in all samples.
    pub fn depth(depth: DepthUse, samples: u32) -> Self {
        Self {
            job: &jobs::depth::JOB,
            vertex: "vertex",
            fragment: None,
            depth,
            ids: false,
            samples,
            mask: !0,
        }
    }

    /// Depth and ids.
    pub fn ids(samples: u32) -> Self {
        Self {
            job: &jobs::identity::JOB,
            fragment: Some("fragment"),
            ids: true,
            ..Self::depth(DepthUse::Writes, samples)
        }
    }
}

/// A pipeline, bound to what its entry points use.
pub(super) struct RasterPipeline {
    pub pipeline: wgpu::RenderPipeline,
    layouts: Vec<wgpu::BindGroupLayout>,
}

impl RasterPipeline {
    pub fn new(gpu: &Gpu, desc: &RasterDesc) -> Self {
        let job = desc.job;
        let entries = [Some(desc.vertex), desc.fragment];
        let is_used = |uses: &str| entries.contains(&Some(uses));
        let layouts: Vec<_> = (0..job.group_count())
            .map(|group| {
                let used: Vec<_> = job
                    .bindings
                    .iter()
                    .filter(|binding| binding.group == group)
                    .filter(|binding| {
                        binding
                            .uses
                            .iter()
                            .any(|used| is_used(used.entry_point.as_ref()))
                    })
                    .map(|binding| binding.entry)
                    .collect();
                let label = Some(job.name.as_ref());
                gpu.device
                    .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                        label,
                        entries: &used,
                    })
            })
            .collect();
        let groups: Vec<_> = layouts.iter().map(Some).collect();
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(job.name.as_ref()),
                bind_group_layouts: &groups,
                immediate_size: 0,
            });
        let module = gpu.shader_module(job);
        let targets = [desc.ids.then_some(IDENTITY_FORMAT.into())];
        let fragment = desc.fragment.map(|entry| wgpu::FragmentState {
            module: &module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            targets: if desc.ids { &targets } else { &[] },
        });
        let step = |step_mode, array_stride, attributes| {
            Some(wgpu::VertexBufferLayout {
                array_stride,
                step_mode,
                attributes,
            })
        };
        let pipeline = gpu
            .device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(job.name.as_ref()),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(desc.vertex),
                    compilation_options: Default::default(),
                    buffers: &[
                        step(
                            wgpu::VertexStepMode::Vertex,
                            12,
                            &wgpu::vertex_attr_array![0 => Float32x3],
                        ),
                        step(
                            wgpu::VertexStepMode::Instance,
                            4,
                            &wgpu::vertex_attr_array![1 => Uint32],
                        ),
                    ],
                },
                primitive: Default::default(),
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: DEPTH_FORMAT,
                    depth_write_enabled: Some(desc.depth == DepthUse::Writes),
                    // Reversed depth; a tie counts as visible.
                    depth_compare: Some(match desc.depth {
                        DepthUse::Ignores => wgpu::CompareFunction::Always,
                        _ => wgpu::CompareFunction::GreaterEqual,
                    }),
                    stencil: Default::default(),
                    bias: Default::default(),
                }),
                multisample: wgpu::MultisampleState {
                    count: desc.samples,
                    mask: desc.mask,
                    alpha_to_coverage_enabled: false,
                },
                fragment,
                multiview_mask: None,
                cache: None,
            });
        Self { pipeline, layouts }
    }

    /// A bind group of these resources by binding.
    pub fn group(
        &self,
        gpu: &Gpu,
        group: usize,
        resources: &[(u32, wgpu::BindingResource<'_>)],
    ) -> Option<wgpu::BindGroup> {
        let entries: Vec<_> = resources
            .iter()
            .map(|(binding, resource)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: resource.clone(),
            })
            .collect();
        Some(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("self-test"),
            layout: self.layouts.get(group)?,
            entries: &entries,
        }))
    }
}

/// Rectangles on the device, ready to be drawn in an image of one size.
pub(super) struct Sheets {
    pub view: wgpu::Buffer,
    pub instances: wgpu::Buffer,
    positions: wgpu::Buffer,
    indices: wgpu::Buffer,
    slots: wgpu::Buffer,
    count: u32,
}

/// Indices of a quad.
pub(super) const QUAD_INDICES: u32 = 6;

impl Sheets {
    pub fn new<'r>(
        bench: &Bench<'_>,
        size: [u32; 2],
        rects: impl Iterator<Item = &'r Rect>,
    ) -> Self {
        let instances: Vec<GpuInstance> = rects.map(|rect| rect.instance(size)).collect();
        let slots: Vec<u32> = (0..instances.len() as u32).collect();
        let corners = [
            [-1.0f32, -1.0, 0.0],
            [1.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
            [-1.0, 1.0, 0.0],
        ];
        let view = GpuView::new(CLIP_FROM_RELATIVE, EYE, size);
        Self {
            view: bench.buffer(&[view], wgpu::BufferUsages::UNIFORM),
            instances: bench.buffer(&instances, wgpu::BufferUsages::STORAGE),
            positions: bench.buffer(&corners, wgpu::BufferUsages::VERTEX),
            indices: bench.buffer(&[0u32, 1, 2, 2, 3, 0], wgpu::BufferUsages::INDEX),
            slots: bench.buffer(&slots, wgpu::BufferUsages::VERTEX),
            count: slots.len() as u32,
        }
    }

    /// The number of rectangles.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// The bind group of the view and the instances.
    pub fn group(&self, gpu: &Gpu, pipeline: &RasterPipeline) -> Option<wgpu::BindGroup> {
        let resources = [
            (0, self.view.as_entire_binding()),
            (1, self.instances.as_entire_binding()),
        ];
        pipeline.group(gpu, 0, &resources)
    }

    /// Binds the pipeline, its first group and the vertices. The slots are those of all rectangles, unless others are given.
    pub fn begin(
        &self,
        gpu: &Gpu,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &RasterPipeline,
        slots: Option<&wgpu::Buffer>,
    ) {
        pass.set_pipeline(&pipeline.pipeline);
        pass.set_bind_group(0, self.group(gpu, pipeline).as_ref(), &[]);
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_vertex_buffer(1, slots.unwrap_or(&self.slots).slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    /// Draws all rectangles.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.draw_indexed(0..QUAD_INDICES, 0, 0..self.count);
    }
}

/// What a pass draws into.
pub(super) struct Attachments<'a> {
    pub depth: &'a wgpu::TextureView,
    /// Whether the depth is cleared first.
    pub clears: bool,
    pub ids: Option<&'a wgpu::TextureView>,
    pub queries: Option<&'a wgpu::QuerySet>,
}

/// Begins a pass.
pub(super) fn pass<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    into: &Attachments<'_>,
) -> wgpu::RenderPass<'e> {
    let ids = into.ids.map(|view| wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
            store: wgpu::StoreOp::Store,
        },
    });
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("self-test"),
        color_attachments: if ids.is_some() {
            std::slice::from_ref(&ids)
        } else {
            &[]
        },
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: into.depth,
            depth_ops: Some(wgpu::Operations {
                load: match into.clears {
                    true => wgpu::LoadOp::Clear(0.0),
                    false => wgpu::LoadOp::Load,
                },
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        occlusion_query_set: into.queries,
        ..Default::default()
    })
}
