//! The engine: its own meshes, materials, pipeline, matrices and depth (forward, of one or several samples a pixel). It knows nothing of Antumbra. Objects have slots; what is drawn, indirect
//! draws and a list of slots say.

use std::f32::consts::PI;

use glam::{Mat4, Vec3};
use wgpu::util::DeviceExt as _;

pub const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

const SHADER: &str = "
    struct View { clip_from_world: mat4x4<f32> }
    struct Object { world: mat4x4<f32>, material: u32, pad_a: u32, pad_b: u32, pad_c: u32 }
    @group(0) @binding(0) var<uniform> view: View;
    @group(0) @binding(1) var<storage, read> objects: array<Object>;
    @group(0) @binding(2) var<storage, read> materials: array<vec4<f32>>;
    struct Varying {
        @invariant @builtin(position) clip: vec4<f32>,
        @location(0) normal: vec3<f32>,
        @location(1) @interpolate(flat) material: u32,
    }
    @vertex fn vertex(@location(0) place: vec3<f32>, @location(1) normal: vec3<f32>, @location(2) slot: u32) -> Varying {
        let object = objects[slot];
        let world = object.world * vec4<f32>(place, 1.0);
        return Varying(view.clip_from_world * world, (object.world * vec4<f32>(normal, 0.0)).xyz, object.material);
    }
    @fragment fn fragment(in: Varying) -> @location(0) vec4<f32> {
        let light = 0.3 + 0.7 * max(dot(normalize(in.normal), vec3<f32>(0.48, 0.8, 0.36)), 0.0);
        return vec4<f32>(materials[in.material].rgb * light, 1.0);
    }
";

/// A mesh in the shared buffers.
#[derive(Debug, Clone, Copy)]
pub struct Mesh {
    pub first_index: u32,
    pub indices: u32,
    pub base_vertex: i32,
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Default)]
struct Object {
    world: [f32; 16],
    material: [u32; 4],
}

pub struct Engine {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub meshes: Vec<Mesh>,
    pub samples: u32,
    pipeline: wgpu::RenderPipeline,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    materials: wgpu::Buffer,
    objects: wgpu::Buffer,
    slots: Vec<Object>,
}

/// A view's matrix and textures.
pub struct View {
    pub size: [u32; 2],
    pub depth: wgpu::Texture,
    pub image: wgpu::Texture,
    colour: wgpu::Texture,
    uniform: wgpu::Buffer,
}

impl Engine {
    pub fn new(device: wgpu::Device, queue: wgpu::Queue, samples: u32, most_objects: u32) -> Self {
        let (vertices, indices, meshes) = meshes();
        let buffer = |contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("engine"),
                contents,
                usage,
            })
        };
        let colours = [
            [0.9, 0.3, 0.2, 1.0],
            [0.2, 0.6, 0.9, 1.0],
            [0.9, 0.8, 0.3, 1.0],
            [0.5, 0.8, 0.4, 1.0f32],
        ];
        let slots = vec![Object::default(); most_objects as usize];
        Self {
            pipeline: pipeline(&device, samples),
            vertices: buffer(
                &bytes(vertices.iter().flatten().copied().map(f32::to_le_bytes)),
                wgpu::BufferUsages::VERTEX,
            ),
            indices: buffer(
                &bytes(indices.iter().copied().map(u32::to_le_bytes)),
                wgpu::BufferUsages::INDEX,
            ),
            materials: buffer(
                &bytes(colours.iter().flatten().copied().map(f32::to_le_bytes)),
                wgpu::BufferUsages::STORAGE,
            ),
            objects: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("objects"),
                size: slots.len() as u64 * size_of::<Object>() as u64,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            device,
            queue,
            meshes,
            samples,
            slots,
        }
    }

    /// Puts an object into a slot, or moves it.
    pub fn place(&mut self, slot: u32, world: Mat4, material: u32) {
        self.slots[slot as usize] = Object {
            world: world.to_cols_array(),
            material: [material, 0, 0, 0],
        };
    }

    /// Uploads the objects.
    pub fn upload(&self) {
        let words = self.slots.iter().flat_map(|object| {
            let numbers = object.world.iter().map(|number| number.to_bits());
            numbers.chain(object.material)
        });
        self.queue
            .write_buffer(&self.objects, 0, &bytes(words.map(u32::to_le_bytes)));
    }

    pub fn view(&self, size: [u32; 2]) -> View {
        let texture = |format, samples, further| {
            self.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("engine"),
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
        View {
            size,
            // The judge reads it as a texture.
            depth: texture(DEPTH, self.samples, wgpu::TextureUsages::TEXTURE_BINDING),
            colour: texture(COLOUR, self.samples, wgpu::TextureUsages::empty()),
            image: texture(COLOUR, 1, wgpu::TextureUsages::COPY_SRC),
            uniform: self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("view"),
                size: 64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
        }
    }

    pub fn look(&self, view: &View, clip_from_world: Mat4) {
        let numbers = clip_from_world
            .to_cols_array()
            .into_iter()
            .map(f32::to_le_bytes);
        self.queue.write_buffer(&view.uniform, 0, &bytes(numbers));
    }

    /// Draws one indirect draw a mesh. `slots` holds the slots that are drawn. `first` clears the image before.
    pub fn draw(
        &self,
        view: &View,
        draws: &wgpu::Buffer,
        slots: &wgpu::Buffer,
        first: bool,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let buffers = [&view.uniform, &self.objects, &self.materials];
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[0, 1, 2].map(|binding| wgpu::BindGroupEntry {
                binding,
                resource: buffers[binding as usize].as_entire_binding(),
            }),
        });
        let [colour, image, depth] = [&view.colour, &view.image, &view.depth]
            .map(|texture| texture.create_view(&Default::default()));
        let background = wgpu::Color {
            r: 0.02,
            g: 0.03,
            b: 0.05,
            a: 1.0,
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("engine"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: if self.samples > 1 { &colour } else { &image },
                depth_slice: None,
                resolve_target: (self.samples > 1).then_some(&image),
                ops: wgpu::Operations {
                    load: if first {
                        wgpu::LoadOp::Clear(background)
                    } else {
                        wgpu::LoadOp::Load
                    },
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: if first {
                        wgpu::LoadOp::Clear(1.0)
                    } else {
                        wgpu::LoadOp::Load
                    },
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_vertex_buffer(1, slots.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        for mesh in 0..self.meshes.len() as u64 {
            pass.draw_indexed_indirect(draws, mesh * 20);
        }
    }
}

pub fn bytes<const N: usize>(numbers: impl Iterator<Item = [u8; N]>) -> Vec<u8> {
    numbers.flatten().collect()
}

/// A box, a double pyramid and a ball within the cube from -1 to 1: vertices (place, normal) and indices.
fn meshes() -> (Vec<[f32; 6]>, Vec<u32>, Vec<Mesh>) {
    let (mut vertices, mut indices, mut meshes) = (Vec::new(), Vec::new(), Vec::new());
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    let sphere = |rings: u32| {
        let at = move |ring: u32, step: u32| {
            let (up, round) = (
                ring as f32 / rings as f32 * PI,
                step as f32 / rings as f32 * PI,
            );
            Vec3::new(up.sin() * round.cos(), up.cos(), -up.sin() * round.sin())
        };
        let cells = (0..rings).flat_map(move |ring| (0..2 * rings).map(move |step| (ring, step)));
        cells
            .flat_map(move |(ring, step)| {
                let [a, b, c, d] = [
                    at(ring, step),
                    at(ring + 1, step),
                    at(ring + 1, step + 1),
                    at(ring, step + 1),
                ];
                [[a, b, c], [a, c, d]]
            })
            .collect::<Vec<_>>()
    };
    let square = |n: Vec3, u: Vec3| {
        let v = n.cross(u);
        [
            [n - u - v, n + u - v, n + u + v],
            [n - u - v, n + u + v, n - u + v],
        ]
    };
    let cube: Vec<[Vec3; 3]> = [(x, y), (-x, y), (y, z), (-y, z), (z, x), (-z, x)]
        .into_iter()
        .flat_map(|(n, u)| square(n, u))
        .collect();
    for (triangles, round) in [(cube, false), (sphere(2), false), (sphere(9), true)] {
        meshes.push(Mesh {
            first_index: indices.len() as u32,
            indices: triangles.len() as u32 * 3,
            base_vertex: vertices.len() as i32,
        });
        for (number, [a, b, c]) in triangles.into_iter().enumerate() {
            let flat = (b - a).cross(c - a).normalize_or_zero();
            for (corner, place) in [a, b, c].into_iter().enumerate() {
                let normal = if round { place } else { flat };
                vertices.push([place.x, place.y, place.z, normal.x, normal.y, normal.z]);
                indices.push(number as u32 * 3 + corner as u32);
            }
        }
    }
    (vertices, indices, meshes)
}

fn pipeline(device: &wgpu::Device, samples: u32) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("engine"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let vertex = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
    let slot = wgpu::vertex_attr_array![2 => Uint32];
    let buffer = |stride, step, attributes| {
        Some(wgpu::VertexBufferLayout {
            array_stride: stride,
            step_mode: step,
            attributes,
        })
    };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("engine"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[
                buffer(24, wgpu::VertexStepMode::Vertex, &vertex),
                buffer(4, wgpu::VertexStepMode::Instance, &slot),
            ],
        },
        primitive: wgpu::PrimitiveState {
            cull_mode: Some(wgpu::Face::Back),
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState {
            count: samples,
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
    })
}
