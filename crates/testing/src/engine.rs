//! A renderer that is not ours: boxes with a pipeline, a vertex buffer, a depth and a matrix of its own. It draws what it is told to.

use antumbra_cull::Gpu;
use antumbra_cull::judge::{DepthRange, HostDepth};
use antumbra_cull::read_back;
use glam::{DAffine3, DVec3, Mat4};

const SHADER: &str = "
    @group(0) @binding(0) var<uniform> clip_from_world: mat4x4<f32>;
    @group(0) @binding(1) var<storage, read> places: array<mat4x4<f32>>;
    struct Varying {
        @invariant @builtin(position) clip: vec4<f32>,
        @location(0) @interpolate(flat) index: u32,
    }
    @vertex fn vertex(@builtin(vertex_index) corner: u32, @location(0) index: u32) -> Varying {
        let far = (vec3<u32>(0x287au, 0x02afu, 0x31e3u) & vec3<u32>(1u << corner)) != vec3<u32>(0u);
        let local = select(vec3<f32>(-1.0), vec3<f32>(1.0), far);
        return Varying(clip_from_world * (places[index] * vec4<f32>(local, 1.0)), index);
    }
    @fragment fn fragment(in: Varying) -> @location(0) vec4<f32> {
        let hash = (in.index + 1u) * 2654435769u;
        return vec4<f32>(vec3<f32>((vec3<u32>(hash) >> vec3<u32>(8u, 16u, 24u)) & vec3<u32>(255u)) / 255.0, 1.0);
    }
";

/// Vertices of a box: a triangle strip.
pub const BOX_VERTICES: u32 = 14;

/// An engine with one view.
pub struct Engine {
    gpu: Gpu,
    size: [u32; 2],
    depth: HostDepth,
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    matrix: wgpu::Buffer,
    places: wgpu::Buffer,
    colour: wgpu::Texture,
    resolved: wgpu::Texture,
    depth_texture: wgpu::Texture,
}

/// What an engine draws.
#[derive(Clone, Copy)]
pub enum Drawn<'a> {
    /// One indirect draw: the draws and the indices.
    Indirect(&'a wgpu::Buffer, &'a wgpu::Buffer),
    /// These indices, in order.
    List(&'a [u32]),
}

impl Engine {
    /// An engine for an image of `size` pixels with this depth.
    pub fn new(gpu: &Gpu, size: [u32; 2], depth: HostDepth) -> Self {
        let device = &gpu.device;
        let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty: wgpu::BindingType::Buffer {
                ty,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[
                entry(
                    0,
                    wgpu::ShaderStages::VERTEX,
                    wgpu::BufferBindingType::Uniform,
                ),
                entry(
                    1,
                    wgpu::ShaderStages::VERTEX,
                    wgpu::BufferBindingType::Storage { read_only: true },
                ),
            ],
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("engine"),
            source: wgpu::ShaderSource::Wgsl(SHADER.into()),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("engine"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: 4,
                    step_mode: wgpu::VertexStepMode::Instance,
                    attributes: &wgpu::vertex_attr_array![0 => Uint32],
                })],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                ..Default::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: depth.format,
                depth_write_enabled: Some(true),
                depth_compare: Some(match depth.range {
                    DepthRange::Reversed => wgpu::CompareFunction::GreaterEqual,
                    DepthRange::Forward => wgpu::CompareFunction::LessEqual,
                }),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: depth.samples,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: Default::default(),
                targets: &[Some(COLOUR.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let buffer = |size, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let [colour, resolved, depth_texture] = textures(gpu, size, depth);
        Self {
            gpu: gpu.clone(),
            size,
            depth,
            pipeline,
            layout,
            matrix: buffer(64, wgpu::BufferUsages::UNIFORM),
            places: buffer(64, wgpu::BufferUsages::STORAGE),
            colour,
            resolved,
            depth_texture,
        }
    }

    /// Gives the image another size.
    pub fn resize(&mut self, size: [u32; 2]) {
        self.size = size;
        [self.colour, self.resolved, self.depth_texture] = textures(&self.gpu, size, self.depth);
    }

    /// The depth.
    pub fn depth(&self) -> &wgpu::Texture {
        &self.depth_texture
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Takes the boxes' transforms, which map the cube from -1 to 1, by index. `None` is not drawn.
    pub fn place(&mut self, places: &[Option<DAffine3>]) {
        let numbers: Vec<u8> = places
            .iter()
            .map(|at| at.map_or(Mat4::ZERO, |at| Mat4::from(at.as_affine3a())))
            .flat_map(|matrix| matrix.to_cols_array())
            .flat_map(f32::to_le_bytes)
            .collect();
        self.places = upload(&self.gpu, &numbers, wgpu::BufferUsages::STORAGE);
    }

    /// Sets the matrix from the world to clip space.
    pub fn look(&mut self, clip_from_relative: Mat4, eye: DVec3) {
        let matrix = clip_from_relative * Mat4::from_translation(-eye.as_vec3());
        let bytes: Vec<u8> = matrix
            .to_cols_array()
            .into_iter()
            .flat_map(f32::to_le_bytes)
            .collect();
        self.gpu.queue.write_buffer(&self.matrix, 0, &bytes);
    }

    /// Draws; `first` clears the image before.
    pub fn draw(&self, encoder: &mut wgpu::CommandEncoder, drawn: Drawn<'_>, first: bool) {
        let group = self
            .gpu
            .device
            .create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &self.layout,
                entries: &[(0, &self.matrix), (1, &self.places)].map(|(binding, buffer)| {
                    wgpu::BindGroupEntry {
                        binding,
                        resource: buffer.as_entire_binding(),
                    }
                }),
            });
        let [colour, resolved, depth] = [&self.colour, &self.resolved, &self.depth_texture]
            .map(|texture| texture.create_view(&Default::default()));
        let far = match self.depth.range {
            DepthRange::Reversed => 0.0,
            DepthRange::Forward => 1.0,
        };
        let many = self.depth.samples > 1;
        let stencil = self.depth.format.has_stencil_aspect();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("engine"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: if many { &colour } else { &resolved },
                depth_slice: None,
                resolve_target: many.then_some(&resolved),
                ops: wgpu::Operations {
                    load: match first {
                        true => wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        false => wgpu::LoadOp::Load,
                    },
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: match first {
                        true => wgpu::LoadOp::Clear(far),
                        false => wgpu::LoadOp::Load,
                    },
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: stencil.then_some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0),
                    store: wgpu::StoreOp::Store,
                }),
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        match drawn {
            Drawn::Indirect(draws, kept) => {
                pass.set_vertex_buffer(0, kept.slice(..));
                pass.draw_indirect(draws, 0);
            }
            Drawn::List([]) => {}
            Drawn::List(indices) => {
                let bytes = indices.iter().copied().flat_map(u32::to_le_bytes);
                let buffer = upload(
                    &self.gpu,
                    &bytes.collect::<Vec<u8>>(),
                    wgpu::BufferUsages::VERTEX,
                );
                pass.set_vertex_buffer(0, buffer.slice(..));
                pass.draw(0..BOX_VERTICES, 0..indices.len() as u32);
            }
        }
    }

    /// The image, four bytes a pixel.
    pub fn pixels(&self) -> Vec<u8> {
        read_back::texture(&self.gpu, &self.resolved).unwrap()
    }
}

fn upload(gpu: &Gpu, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: bytes.len().max(64) as u64,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    gpu.queue.write_buffer(&buffer, 0, bytes);
    buffer
}

const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

fn textures(gpu: &Gpu, size: [u32; 2], depth: HostDepth) -> [wgpu::Texture; 3] {
    let make = |format, samples, further| {
        gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: samples,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | further,
            view_formats: &[],
        })
    };
    [
        make(COLOUR, depth.samples, wgpu::TextureUsages::empty()),
        make(COLOUR, 1, wgpu::TextureUsages::COPY_SRC),
        make(
            depth.format,
            depth.samples,
            wgpu::TextureUsages::TEXTURE_BINDING,
        ),
    ]
}
