//! A device to test on, small pipelines, and blocking reads of a plan's outputs.

use antumbra_graph::{CompileOptions, Graph, Plan};

pub struct Gpu {
    pub adapter: wgpu::Adapter,
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
}

/// A device on Vulkan.
pub fn vulkan() -> Gpu {
    gpu(wgpu::Backends::VULKAN)
}

/// A device on this backend, with timestamps if it has them.
pub fn gpu(backends: wgpu::Backends) -> Gpu {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapter =
        pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .unwrap_or_else(|error| {
                panic!("no adapter for {backends:?}: {error}; Debian's mesa-vulkan-drivers and libegl1 bring software ones")
            });
    let wanted = wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
        required_features: adapter.features() & wanted,
        required_limits: adapter.limits(),
        ..Default::default()
    }))
    .expect("a device with the adapter's own limits");
    Gpu {
        adapter,
        device,
        queue,
    }
}

impl Gpu {
    pub fn compile(&self, graph: Graph) -> Plan {
        graph
            .compile(&CompileOptions::owned(&self.device).adapter(&self.adapter))
            .unwrap_or_else(|errors| panic!("{errors}"))
    }

    pub fn wait(&self) {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the device finishes");
    }

    /// The first `bytes` bytes of a buffer.
    pub fn read(&self, buffer: &wgpu::Buffer, bytes: u64) -> Vec<u8> {
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: bytes,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, bytes);
        self.queue.submit([encoder.finish()]);
        staging.slice(..).map_async(wgpu::MapMode::Read, |_| {});
        self.wait();
        staging.slice(..).get_mapped_range().unwrap().to_vec()
    }

    pub fn read_u32(&self, buffer: &wgpu::Buffer, count: u64) -> Vec<u32> {
        bytemuck::pod_collect_to_vec(&self.read(buffer, count * 4))
    }

    pub fn read_u64(&self, buffer: &wgpu::Buffer, count: u64) -> Vec<u64> {
        bytemuck::pod_collect_to_vec(&self.read(buffer, count * 8))
    }

    /// The middle texel of a texture 64 texels wide, with four bytes a texel.
    pub fn middle(&self, texture: &wgpu::Texture) -> [u8; 4] {
        let bytes = u64::from(texture.height()) * 256;
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: bytes,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(256),
                    rows_per_image: None,
                },
            },
            texture.size(),
        );
        self.queue.submit([encoder.finish()]);
        let bytes = self.read(&buffer, bytes);
        let at = (texture.height() as usize / 2) * 256 + 32 * 4;
        [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]
    }

    /// Draws a triangle that covers the target, at depth `instance_index / 8192`, in this colour; `None` for depth only.
    pub fn fill(&self, colour: Option<&str>, depth: Option<bool>) -> wgpu::RenderPipeline {
        let source = format!(
            "@vertex fn vertex(@builtin(vertex_index) v: u32, @builtin(instance_index) i: u32) -> @builtin(position) vec4f {{
                let corner = vec2f(f32((v << 1u) & 2u), f32(v & 2u)) * 2.0 - 1.0;
                return vec4f(corner, f32(i) / 8192.0, 1.0);
            }}
            @fragment fn fragment() -> @location(0) vec4f {{ return {}; }}",
            colour.unwrap_or("vec4f(0.0)"),
        );
        let module = self
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl(source.into()),
            });
        self.device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: None,
                layout: None,
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("vertex"),
                    compilation_options: Default::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: depth.map(|write| wgpu::DepthStencilState {
                    format: wgpu::TextureFormat::Depth32Float,
                    depth_write_enabled: Some(write),
                    depth_compare: Some(wgpu::CompareFunction::Greater),
                    stencil: Default::default(),
                    bias: Default::default(),
                }),
                multisample: Default::default(),
                fragment: colour.map(|_| wgpu::FragmentState {
                    module: &module,
                    entry_point: Some("fragment"),
                    compilation_options: Default::default(),
                    targets: &[Some(wgpu::ColorTargetState {
                        format: wgpu::TextureFormat::Rgba8Unorm,
                        blend: None,
                        write_mask: wgpu::ColorWrites::ALL,
                    })],
                }),
                multiview_mask: None,
                cache: None,
            })
    }

    /// A compute pipeline of one workgroup over one storage buffer, `data: array<u32>`.
    pub fn compute(&self, body: &str) -> wgpu::ComputePipeline {
        let source = format!(
            "@group(0) @binding(0) var<storage, read_write> data: array<u32>;
            @compute @workgroup_size(1) fn main() {{ {body} }}"
        );
        let module = self
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl(source.into()),
            });
        self.device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: None,
                module: &module,
                entry_point: Some("main"),
                compilation_options: Default::default(),
                cache: None,
            })
    }
}
