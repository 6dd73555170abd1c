//! Hardware occlusion queries over boxes that belong to no mesh, such as the bounding boxes of hierarchy nodes.
//!
//! A rasteriser snaps vertices, and f32 rounds them. So that a rasterised box covers every sample of its contents, each box is widened by a
//! fraction of a pixel as seen from the eye, and by no more.

use antumbra_graph::{Bind, Buffer, Graph, Host, HostBuilder, Texture};
use antumbra_scene::Aabb;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

use crate::device::Gpu;
use crate::entities::OrientedBox;
use crate::renderer::{DEPTH_FORMAT, ViewInputs};
use crate::subpixel;
use crate::view::ViewFrame;
use antumbra_shaders::jobs::boxes::JOB;
use std::sync::Arc;

/// A box as the GPU draws it: centre and half edges in metres, relative to the eye.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct GpuBox {
    centre: [f32; 3],
    half: [[f32; 3]; 3],
}

impl GpuBox {
    /// A box with this centre and these half edges, which must be right-handed.
    pub(crate) fn new(centre: [f32; 3], half: [[f32; 3]; 3]) -> Self {
        Self { centre, half }
    }
}

/// What boxes hold, which decides how much they are widened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoxContents {
    /// Triangles only.
    Triangles,
    /// Lines or points too. They cover pixels that they do not touch.
    AnyTopology,
}

/// How the boxes of one view are widened.
#[derive(Debug, Clone, Copy)]
pub struct Widening {
    eye: DVec3,
    /// Metres of widening for each metre of distance, and at no distance.
    share: f64,
    constant: f64,
}

/// The error of f32 positions, as a fraction of the distance.
const ROUNDING: f64 = 1e-6;

impl Widening {
    /// For boxes seen by this view.
    pub fn new(view: &ViewFrame, contents: BoxContents) -> Self {
        let pixels = match contents {
            BoxContents::Triangles => subpixel::DRAWN,
            BoxContents::AnyTopology => subpixel::LINES,
        };
        let scale = view.pixel_scale();
        let metres = |reach: f64| scale.most_divisor(reach) * pixels / scale.least;
        Self {
            eye: view.camera.position,
            share: metres(1.0) - metres(0.0) + ROUNDING,
            constant: metres(0.0),
        }
    }

    /// By how many metres a box is widened whose farthest point is `reach` metres from the eye.
    pub fn margin(&self, reach: f64) -> f64 {
        self.constant + reach * self.share
    }

    /// The widened box; `None` where f32 cannot hold it.
    pub fn oriented(&self, what: &OrientedBox) -> Option<GpuBox> {
        let centre = what.centre - self.eye;
        let reach = centre.length() + f64::from(what.half.length());
        let half = what.half + Vec3::splat(self.margin(reach) as f32);
        let [x, y, z] = [0, 1, 2].map(|i| what.axes[i] * half[i]);
        // The strip's front faces point outwards only for right-handed axes. Mirroring a box does not change it.
        let z = if x.cross(y).dot(z) < 0.0 { -z } else { z };
        let made = GpuBox {
            centre: centre.as_vec3().to_array(),
            half: [x, y, z].map(|axis| axis.to_array()),
        };
        let fits = bytemuck::cast_slice::<GpuBox, f32>(std::slice::from_ref(&made))
            .iter()
            .all(|number| number.is_finite());
        fits.then_some(made)
    }

    /// The widened box's corners, relative to the eye; `None` where f32 cannot hold it.
    pub fn corners(&self, what: &OrientedBox) -> Option<[Vec3; 8]> {
        let GpuBox { centre, half } = self.oriented(what)?;
        let [x, y, z] = half.map(Vec3::from);
        Some(std::array::from_fn(|corner| {
            let side = |bit: usize, axis: Vec3| if corner >> bit & 1 == 0 { axis } else { -axis };
            Vec3::from(centre) + side(0, x) + side(1, y) + side(2, z)
        }))
    }

    /// The widened box around world bounds; `None` where f32 cannot hold it.
    pub fn aligned(&self, bounds: &Aabb) -> Option<GpuBox> {
        self.oriented(&OrientedBox::aligned(bounds))
    }
}

/// Boxes in the order of their queries. A query covers one box, or several neighbours.
#[derive(Debug, Clone, Default)]
pub struct BoxList {
    boxes: Vec<GpuBox>,
    /// Where each query's boxes end.
    ends: Vec<u32>,
}

impl BoxList {
    /// Empties the list. The memory is kept.
    pub fn clear(&mut self) {
        self.boxes.clear();
        self.ends.clear();
    }

    /// Adds a box with a query of its own.
    pub fn push(&mut self, made: GpuBox) {
        self.boxes.push(made);
        self.ends.push(self.boxes.len() as u32);
    }

    /// Adds a box to the last query; to a query of its own where there is none.
    pub fn push_to_last(&mut self, made: GpuBox) {
        self.ends.pop();
        self.push(made);
    }

    /// The boxes.
    pub fn boxes(&self) -> &[GpuBox] {
        &self.boxes
    }

    /// Where each query's boxes end.
    pub fn query_ends(&self) -> &[u32] {
        &self.ends
    }

    /// Number of queries.
    pub fn query_count(&self) -> u32 {
        self.ends.len() as u32
    }
}

/// A list of boxes, with the boxes on the GPU.
#[derive(Debug, Clone, Copy)]
pub struct BoxDraws {
    /// The list.
    pub list: Host<BoxList>,
    /// [`BoxList::boxes`], uploaded.
    pub buffer: Buffer,
}

impl BoxDraws {
    /// Declares on a host node that it writes the boxes and uploads them. Returns the versions it writes.
    pub fn written_by(self, node: &mut HostBuilder<'_>) -> Self {
        Self {
            list: node.write(self.list),
            buffer: node.upload(self.buffer),
        }
    }
}

/// What boxes are drawn for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BoxPurpose {
    /// To query what they hold, against a depth that stays as it is.
    Query,
    /// To hide others: they write depth.
    Hide,
}

/// The pipeline that draws boxes.
#[derive(Debug)]
pub struct BoxPipeline {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl BoxPipeline {
    /// Bytes of a box in [`BoxDraws::buffer`].
    pub const BYTES_A_BOX: u64 = size_of::<GpuBox>() as u64;
    /// Vertices of a box's triangle strip.
    pub(crate) const VERTICES: u32 = 14;

    /// Compiles the pipeline, for depths of `samples` samples a pixel.
    pub fn new(gpu: &Gpu, samples: u32, purpose: BoxPurpose) -> Self {
        let device = &gpu.device;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("boxes"),
            entries: &JOB.layout_entries(0),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("boxes"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Float32x3];
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("boxes"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &gpu.shader_module(&JOB),
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: Self::BYTES_A_BOX,
                    step_mode: wgpu::VertexStepMode::Instance,
                    attributes: &attributes,
                })],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                cull_mode: Some(wgpu::Face::Back),
                ..Default::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(purpose == BoxPurpose::Hide),
                // Reversed depth; a tie counts as visible.
                depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: samples,
                ..Default::default()
            },
            fragment: None,
            multiview_mask: None,
            cache: None,
        });
        Self { pipeline, layout }
    }

    /// The bind group of a view's uniform, for a pass outside of the graph.
    pub(crate) fn group(&self, gpu: &Gpu, view: &wgpu::Buffer) -> wgpu::BindGroup {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("boxes"),
            layout: &self.layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: view.as_entire_binding(),
            }],
        })
    }

    /// Binds the pipeline, its group and the boxes. An instance of [`Self::VERTICES`] vertices is a box.
    pub(crate) fn begin(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        group: &wgpu::BindGroup,
        boxes: &wgpu::Buffer,
    ) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.set_vertex_buffer(0, boxes.slice(..));
    }
}

/// Draws the list's boxes into a depth. Only front faces are drawn, so the eye must not be inside of a box.
pub fn box_depth_pass(
    g: &mut Graph,
    spec: BoxPassSpec,
    inputs: ViewInputs,
    boxes: BoxDraws,
    depth: Texture,
) -> Texture {
    let BoxPassSpec {
        name,
        group,
        pipeline,
    } = spec;
    let mut node = g.raster(name);
    node.group(group)
        .read(boxes.list)
        .vertex(boxes.buffer)
        .uniform(inputs.uniform);
    let depth = node.depth(depth);
    node.run(move |ctx| {
        let group = ctx.bind_group(0, &pipeline.layout, &[Bind::Buffer(0, inputs.uniform)])?;
        let buffer = ctx.buffer(boxes.buffer)?;
        let count = ctx.get(boxes.list)?.boxes().len() as u32;
        pipeline.begin(ctx.pass(), &group, buffer);
        ctx.pass().draw(0..BoxPipeline::VERTICES, 0..count);
        Ok(())
    });
    depth
}

/// A box pass's name, timing group and pipeline.
#[derive(Debug, Clone)]
pub struct BoxPassSpec {
    /// The node's name.
    pub name: String,
    /// The label under which its time is summed.
    pub group: &'static str,
    /// The pipeline.
    pub pipeline: Arc<BoxPipeline>,
}

/// Draws the list's boxes with one hardware query for each of its queries, in order, against a depth that is not written. The results are
/// u64: zero, or something else. Only front faces are drawn, so the eye must not be inside of a box and the near plane must not cut one.
pub fn box_query_pass(
    g: &mut Graph,
    spec: BoxPassSpec,
    inputs: ViewInputs,
    boxes: BoxDraws,
    depth: Texture,
    answers: Buffer,
) -> Buffer {
    let BoxPassSpec {
        name,
        group,
        pipeline,
    } = spec;
    let mut node = g.raster(name);
    node.group(group)
        .read(boxes.list)
        .vertex(boxes.buffer)
        .uniform(inputs.uniform)
        .depth_read(depth)
        // The node's body reports a value that cannot be read.
        .only_if(move |host| {
            host.get(boxes.list)
                .map_or(true, |list| list.query_count() > 0)
        });
    let answers = node.queries(answers, move |host| {
        host.get(boxes.list).map_or(0, |list| list.query_count())
    });
    node.run(move |ctx| {
        let group = ctx.bind_group(0, &pipeline.layout, &[Bind::Buffer(0, inputs.uniform)])?;
        let buffer = ctx.buffer(boxes.buffer)?;
        let list = ctx.get(boxes.list)?;
        let range = ctx.query_range();
        pipeline.begin(ctx.pass(), &group, buffer);
        let ends = list.query_ends();
        for number in range {
            let at = number as usize;
            let first = at.checked_sub(1).and_then(|at| ends.get(at));
            let (first, end) = (first.copied().unwrap_or(0), ends.get(at).copied());
            ctx.query(number, |pass| {
                pass.draw(0..BoxPipeline::VERTICES, first..end.unwrap_or(first))
            })?;
        }
        Ok(())
    });
    answers
}
