//! Draws Bevy's meshes by their positions alone: occluders into a depth, and suspects of an audit against one.

use std::collections::HashMap;
use std::ops::Range;

use antumbra::cull::Gpu;
use bevy::asset::AssetId;
use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::math::Affine3A;
use bevy::prelude::*;
use bevy::render::mesh::allocator::MeshAllocator;
use bevy::render::mesh::{RenderMesh, RenderMeshBufferInfo};
use bevy::render::render_asset::RenderAssets;
use wgpu::util::{BufferInitDescriptor, DeviceExt};

/// A mesh and its place in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placed {
    pub mesh: AssetId<Mesh>,
    pub place: Affine3A,
}

/// Bevy's meshes in the render world.
#[derive(Clone, Copy)]
pub(crate) struct Meshes<'a> {
    pub assets: &'a RenderAssets<RenderMesh>,
    pub allocator: &'a MeshAllocator,
}

/// What a pipeline depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Layout {
    stride: u64,
    offset: u64,
    samples: u32,
}

/// What else a pipeline is made of.
pub(crate) struct PassDesc<'a> {
    pub label: &'a str,
    /// What follows `place.wgsl`.
    pub shader: &'a str,
    /// Its fragment entry point, if it has one.
    pub fragment: Option<&'a str>,
    /// Bindings from 2 on.
    pub entries: &'a [wgpu::BindGroupLayoutEntry],
    pub depth: wgpu::CompareFunction,
    pub writes_depth: bool,
}

/// Pipelines by what they depend on.
#[derive(Default)]
pub(crate) struct Pipelines(HashMap<Layout, wgpu::RenderPipeline>);

/// Meshes that are ready to be drawn.
pub(crate) struct Drawing<'a> {
    calls: Vec<(Call<'a>, Range<u32>)>,
}

/// The uniform and storage buffers of `place.wgsl`.
pub(crate) struct Places {
    pub frame: wgpu::Buffer,
    pub places: wgpu::Buffer,
}

struct Call<'a> {
    layout: Layout,
    vertices: &'a wgpu::Buffer,
    base: u32,
    count: u32,
    indices: Option<Indices<'a>>,
}

struct Indices<'a> {
    buffer: &'a wgpu::Buffer,
    format: wgpu::IndexFormat,
    first: u32,
}

impl Places {
    /// `width` is that of the image, in pixels.
    pub fn new(
        device: &wgpu::Device,
        clip_from_world: Mat4,
        width: u32,
        placed: &[Placed],
    ) -> Self {
        let mut frame = bytes(&clip_from_world.to_cols_array());
        frame.extend(width.to_le_bytes());
        frame.extend([0; 12]);
        let places = placed.iter();
        let places = places.flat_map(|one| bytes(&Mat4::from(one.place).to_cols_array()));
        let filled = |usage, contents: &[u8]| {
            device.create_buffer_init(&BufferInitDescriptor {
                label: Some("antumbra: places"),
                contents,
                usage,
            })
        };
        Self {
            frame: filled(wgpu::BufferUsages::UNIFORM, &frame),
            places: filled(wgpu::BufferUsages::STORAGE, &places.collect::<Vec<u8>>()),
        }
    }
}

impl<'a> Drawing<'a> {
    /// Leaves out what is not on the device, or is not made of triangles.
    pub fn new(placed: &[Placed], meshes: Meshes<'a>, samples: u32) -> Self {
        let mut calls: Vec<(Call<'a>, Range<u32>)> = Vec::new();
        let mut before: Option<&Placed> = None;
        for (one, number) in placed.iter().zip(0u32..) {
            let same = before.is_some_and(|before| before.mesh == one.mesh);
            match calls
                .last_mut()
                .filter(|(_, numbers)| same && numbers.end == number)
            {
                Some((_, numbers)) => numbers.end += 1,
                None => calls.extend(
                    meshes
                        .call(one, samples)
                        .map(|call| (call, number..number + 1)),
                ),
            }
            before = Some(one);
        }
        Self { calls }
    }

    /// A layout that it draws; `None` where nothing is drawn.
    pub fn any(&self) -> Option<Layout> {
        self.calls.first().map(|(call, _)| call.layout)
    }

    /// Makes the pipelines that are missing.
    pub fn prepare(&self, gpu: &Gpu, pipelines: &mut Pipelines, desc: &PassDesc<'_>) {
        for (call, _) in &self.calls {
            let made = || pipeline(gpu, call.layout, desc);
            pipelines.0.entry(call.layout).or_insert_with(made);
        }
    }

    /// Draws. The instance index is the number of what is placed; neighbours of one mesh are one call.
    pub fn record(&self, pass: &mut wgpu::RenderPass<'_>, pipelines: &Pipelines) {
        for (call, numbers) in &self.calls {
            let Some(pipeline) = pipelines.of(call.layout) else {
                continue;
            };
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, call.vertices.slice(..));
            match &call.indices {
                Some(indices) => {
                    pass.set_index_buffer(indices.buffer.slice(..), indices.format);
                    let range = indices.first..indices.first + call.count;
                    pass.draw_indexed(range, call.base as i32, numbers.clone());
                }
                None => pass.draw(call.base..call.base + call.count, numbers.clone()),
            }
        }
    }
}

impl Pipelines {
    pub fn of(&self, layout: Layout) -> Option<&wgpu::RenderPipeline> {
        self.0.get(&layout)
    }
}

impl<'a> Meshes<'a> {
    fn call(&self, placed: &Placed, samples: u32) -> Option<Call<'a>> {
        let mesh = self.assets.get(placed.mesh)?;
        let vertices = self.allocator.mesh_vertex_slice(&placed.mesh)?;
        let layout = &mesh.layout.0;
        let mut ids = layout.attribute_ids().iter();
        let at = ids.position(|id| *id == Mesh::ATTRIBUTE_POSITION.id)?;
        let position = layout.layout().attributes.get(at)?;
        let is_plain = position.format == wgpu::VertexFormat::Float32x3
            && mesh.primitive_topology() == wgpu::PrimitiveTopology::TriangleList;
        let (count, indices) = match mesh.buffer_info {
            RenderMeshBufferInfo::Indexed {
                count,
                index_format,
            } => {
                let slice = self.allocator.mesh_index_slice(&placed.mesh)?;
                let indices = Indices {
                    buffer: slice.buffer,
                    format: index_format,
                    first: slice.range.start,
                };
                (count, Some(indices))
            }
            RenderMeshBufferInfo::NonIndexed => (mesh.vertex_count, None),
        };
        is_plain.then_some(Call {
            layout: Layout {
                stride: layout.layout().array_stride,
                offset: position.offset,
                samples,
            },
            vertices: vertices.buffer,
            base: vertices.range.start,
            count,
            indices,
        })
    }
}

/// An entry of a bind group layout.
pub(crate) fn entry(
    binding: u32,
    visibility: wgpu::ShaderStages,
    ty: wgpu::BindingType,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty,
        count: None,
    }
}

/// A binding of a whole buffer.
pub(crate) fn buffer(ty: wgpu::BufferBindingType) -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn pipeline(gpu: &Gpu, layout: Layout, desc: &PassDesc<'_>) -> wgpu::RenderPipeline {
    let device = &gpu.device;
    let source = [include_str!("meshes/place.wgsl"), desc.shader].concat();
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(desc.label),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    // Bind groups are made for any of the pipelines, so that their layout is spelled out.
    let read = wgpu::BufferBindingType::Storage { read_only: true };
    let mut entries = vec![
        entry(
            0,
            wgpu::ShaderStages::VERTEX_FRAGMENT,
            buffer(wgpu::BufferBindingType::Uniform),
        ),
        entry(1, wgpu::ShaderStages::VERTEX, buffer(read)),
    ];
    entries.extend_from_slice(desc.entries);
    let group = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(desc.label),
        entries: &entries,
    });
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(desc.label),
        bind_group_layouts: &[Some(&group)],
        ..Default::default()
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(desc.label),
        layout: Some(&pipeline_layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("place"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: layout.stride,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &[wgpu::VertexAttribute {
                    format: wgpu::VertexFormat::Float32x3,
                    offset: layout.offset,
                    shader_location: 0,
                }],
            })],
        },
        primitive: wgpu::PrimitiveState {
            // As in Bevy's pipelines, a mirror image keeps the faces whose corners go round this way: those that were at the back.
            cull_mode: Some(wgpu::Face::Back),
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: CORE_3D_DEPTH_FORMAT,
            depth_write_enabled: Some(desc.writes_depth),
            depth_compare: Some(desc.depth),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState {
            count: layout.samples,
            ..Default::default()
        },
        fragment: desc.fragment.map(|fragment| wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn bytes(numbers: &[f32]) -> Vec<u8> {
    let numbers = numbers.iter();
    numbers.flat_map(|number| number.to_le_bytes()).collect()
}
