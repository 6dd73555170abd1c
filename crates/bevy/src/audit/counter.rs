//! Counts wrong pixels on the GPU: draws what was culled against a copy of the depth of the frame in which it was.

use std::collections::HashMap;

use antumbra::cull::Gpu;
use antumbra::graph::{ReadBackCopy, ReadBackRing};
use bevy::math::Affine3A;
use bevy::prelude::*;
use bevy::render::mesh::allocator::MeshAllocator;
use bevy::render::mesh::{RenderMesh, RenderMeshBufferInfo};
use bevy::render::render_asset::RenderAssets;

/// A mesh that was culled, and whose box was not hidden in that very frame.
#[derive(Debug, Clone)]
pub(crate) struct Suspect {
    pub mesh: AssetId<Mesh>,
    pub place: Affine3A,
}

/// Bevy's meshes in the render world.
#[derive(Clone, Copy)]
pub(crate) struct Meshes<'a> {
    pub assets: &'a RenderAssets<RenderMesh>,
    pub allocator: &'a MeshAllocator,
}

/// A camera's copy of its depth, and what draws against it.
pub(crate) struct Counter {
    gpu: Gpu,
    copy: Option<Copied>,
    pipelines: HashMap<Draws, wgpu::RenderPipeline>,
    ring: ReadBackRing<()>,
    counted: u64,
}

struct Copied {
    texture: wgpu::Texture,
    counts: wgpu::Buffer,
}

/// What a pipeline depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct Draws {
    stride: u64,
    offset: u64,
    samples: u32,
    is_mirrored: bool,
}

/// A draw call.
struct Call<'a> {
    draws: Draws,
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

impl Counter {
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gpu: gpu.clone(),
            copy: None,
            pipelines: HashMap::new(),
            ring: ReadBackRing::new(&gpu.device, "antumbra: wrong pixels", 4, 2),
            counted: 0,
        }
    }

    /// Copies a frame's depth.
    pub fn copy(&mut self, depth: &wgpu::Texture, encoder: &mut wgpu::CommandEncoder) {
        let fits = |copied: &Copied| {
            copied.texture.size() == depth.size()
                && copied.texture.sample_count() == depth.sample_count()
                && copied.texture.format() == depth.format()
        };
        let copied = self.copy.take().filter(fits);
        let copied = copied.unwrap_or_else(|| Copied::new(&self.gpu, depth));
        encoder.copy_texture_to_texture(
            depth.as_image_copy(),
            copied.texture.as_image_copy(),
            depth.size(),
        );
        self.copy = Some(copied);
    }

    /// Draws suspects against the copy, with the matrix of its frame, and asks for the number of pixels.
    pub fn count(
        &mut self,
        suspects: &[Suspect],
        clip_from_world: Mat4,
        meshes: Meshes<'_>,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let Some(copied) = self.copy.take() else {
            return;
        };
        let samples = copied.texture.sample_count();
        let calls = suspects.iter().map(|one| meshes.call(one, samples));
        let calls: Vec<Option<Call<'_>>> = calls.collect();
        for draws in calls.iter().flatten().map(|call| call.draws) {
            let made = || pipeline(&self.gpu, draws);
            self.pipelines.entry(draws).or_insert_with(made);
        }
        encoder.clear_buffer(&copied.counts, 0, None);
        self.draw(&copied, suspects, &calls, clip_from_world, encoder);
        self.counted += 1;
        let copy = ReadBackCopy {
            source: &copied.counts,
            bytes: 4,
            frame: self.counted,
            tag: (),
        };
        self.ring.ask(copy, encoder);
        self.copy = Some(copied);
    }

    /// The number of pixels, once it has arrived.
    pub fn take(&mut self) -> Option<u32> {
        let mut found = None;
        self.ring.take_newest(|late| {
            found = late
                .bytes
                .first_chunk()
                .map(|bytes| u32::from_le_bytes(*bytes));
        });
        found
    }

    fn draw(
        &self,
        copied: &Copied,
        suspects: &[Suspect],
        calls: &[Option<Call<'_>>],
        clip_from_world: Mat4,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let Some(first) = calls.iter().flatten().next() else {
            return;
        };
        let Some(any) = self.pipelines.get(&first.draws) else {
            return;
        };
        let device = &self.gpu.device;
        let mut frame: Vec<u8> = bytes(&clip_from_world.to_cols_array());
        frame.extend(copied.texture.width().to_le_bytes());
        frame.extend([0; 12]);
        let places = suspects.iter();
        let places = places.flat_map(|one| bytes(&Mat4::from(one.place).to_cols_array()));
        let frame = filled(device, wgpu::BufferUsages::UNIFORM, &frame);
        let places = filled(
            device,
            wgpu::BufferUsages::STORAGE,
            &places.collect::<Vec<u8>>(),
        );
        let depth = copied
            .texture
            .create_view(&wgpu::TextureViewDescriptor::default());
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("antumbra: wrong pixels"),
            layout: &any.get_bind_group_layout(0),
            entries: &[
                entry(0, frame.as_entire_binding()),
                entry(1, places.as_entire_binding()),
                entry(2, copied.counts.as_entire_binding()),
                entry(3, wgpu::BindingResource::TextureView(&depth)),
            ],
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("antumbra: wrong pixels"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                // It is only read.
                depth_ops: None,
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, &group, &[]);
        for (call, number) in calls.iter().zip(0u32..) {
            let Some(call) = call else { continue };
            let Some(pipeline) = self.pipelines.get(&call.draws) else {
                continue;
            };
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, call.vertices.slice(..));
            match &call.indices {
                Some(indices) => {
                    pass.set_index_buffer(indices.buffer.slice(..), indices.format);
                    let range = indices.first..indices.first + call.count;
                    pass.draw_indexed(range, call.base as i32, number..number + 1);
                }
                None => pass.draw(call.base..call.base + call.count, number..number + 1),
            }
        }
    }
}

impl Copied {
    fn new(gpu: &Gpu, depth: &wgpu::Texture) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("antumbra: audited depth"),
            size: depth.size(),
            mip_level_count: 1,
            sample_count: depth.sample_count(),
            dimension: wgpu::TextureDimension::D2,
            format: depth.format(),
            usage: wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let pixels = u64::from(depth.width()) * u64::from(depth.height());
        let counts = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("antumbra: wrong pixels"),
            size: 4 + 4 * pixels,
            usage: wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::COPY_SRC
                | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { texture, counts }
    }
}

impl<'a> Meshes<'a> {
    /// How a suspect is drawn; `None` for one that is not on the device, or is not made of triangles.
    fn call(&self, suspect: &Suspect, samples: u32) -> Option<Call<'a>> {
        let mesh = self.assets.get(suspect.mesh)?;
        let vertices = self.allocator.mesh_vertex_slice(&suspect.mesh)?;
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
                let slice = self.allocator.mesh_index_slice(&suspect.mesh)?;
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
            draws: Draws {
                stride: layout.layout().array_stride,
                offset: position.offset,
                samples,
                is_mirrored: suspect.place.matrix3.determinant() < 0.0,
            },
            vertices: vertices.buffer,
            base: vertices.range.start,
            count,
            indices,
        })
    }
}

fn pipeline(gpu: &Gpu, draws: Draws) -> wgpu::RenderPipeline {
    let (texture, entry) = match draws.samples {
        1 => ("texture_depth_2d", "count_pixels"),
        _ => ("texture_depth_multisampled_2d", "count_samples"),
    };
    let source = include_str!("wrong_pixels.wgsl").replace("DEPTH_TEXTURE", texture);
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("antumbra: wrong pixels"),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
    // Bind groups are made for any of the pipelines, so that their layout is spelled out.
    let entry_of = |binding, visibility, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty,
        count: None,
    };
    let buffer = |ty| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let both = wgpu::ShaderStages::VERTEX_FRAGMENT;
    let fragment = wgpu::ShaderStages::FRAGMENT;
    let storage = |read_only| buffer(wgpu::BufferBindingType::Storage { read_only });
    let group = gpu
        .device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("antumbra: wrong pixels"),
            entries: &[
                entry_of(0, both, buffer(wgpu::BufferBindingType::Uniform)),
                entry_of(1, wgpu::ShaderStages::VERTEX, storage(true)),
                entry_of(2, fragment, storage(false)),
                entry_of(
                    3,
                    fragment,
                    wgpu::BindingType::Texture {
                        sample_type: wgpu::TextureSampleType::Depth,
                        view_dimension: wgpu::TextureViewDimension::D2,
                        multisampled: draws.samples > 1,
                    },
                ),
            ],
        });
    let layout = gpu
        .device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("antumbra: wrong pixels"),
            bind_group_layouts: &[Some(&group)],
            ..Default::default()
        });
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("antumbra: wrong pixels"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("place"),
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: draws.stride,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &[wgpu::VertexAttribute {
                        format: wgpu::VertexFormat::Float32x3,
                        offset: draws.offset,
                        shader_location: 0,
                    }],
                })],
            },
            primitive: wgpu::PrimitiveState {
                // A mirror image turns its faces round.
                front_face: match draws.is_mirrored {
                    true => wgpu::FrontFace::Cw,
                    false => wgpu::FrontFace::Ccw,
                },
                cull_mode: Some(wgpu::Face::Back),
                ..Default::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT,
                depth_write_enabled: Some(false),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: draws.samples,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                targets: &[],
            }),
            multiview_mask: None,
            cache: None,
        })
}

fn filled(device: &wgpu::Device, usage: wgpu::BufferUsages, contents: &[u8]) -> wgpu::Buffer {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("antumbra: wrong pixels"),
        size: contents.len() as u64,
        usage,
        mapped_at_creation: true,
    });
    if let Ok(mut mapped) = buffer.get_mapped_range_mut(..) {
        mapped.copy_from_slice(contents);
    }
    buffer.unmap();
    buffer
}

fn bytes(numbers: &[f32]) -> Vec<u8> {
    numbers
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect()
}
