//! Counts wrong pixels on the GPU: draws what was culled against a copy of the depth of the frame in which it was.

use antumbra::cull::Gpu;
use antumbra::graph::{ReadBackCopy, ReadBackRing};
use bevy::prelude::*;

use crate::meshes::{Drawing, Meshes, PassDesc, Pipelines, Placed, Places, buffer, entry};

/// A camera's copy of its depth, and what draws against it.
pub(crate) struct Counter {
    gpu: Gpu,
    copy: Option<Copied>,
    pipelines: Pipelines,
    ring: ReadBackRing<()>,
    counted: u64,
}

struct Copied {
    texture: wgpu::Texture,
    counts: wgpu::Buffer,
}

impl Counter {
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gpu: gpu.clone(),
            copy: None,
            pipelines: Pipelines::default(),
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
        suspects: &[Placed],
        clip_from_world: Mat4,
        meshes: Meshes<'_>,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let Some(copied) = &self.copy else {
            return;
        };
        let drawing = Drawing::new(suspects, meshes, copied.texture.sample_count());
        drawing.prepare(&self.gpu, &mut self.pipelines, &copied.pass_desc().desc());
        encoder.clear_buffer(&copied.counts, 0, None);
        self.draw(copied, suspects, &drawing, clip_from_world, encoder);
        self.counted += 1;
        let copy = ReadBackCopy {
            source: &copied.counts,
            bytes: 4,
            frame: self.counted,
            tag: (),
        };
        self.ring.ask(copy, encoder);
    }

    /// The number of pixels, once it has arrived.
    pub fn take(&mut self) -> Option<u32> {
        let mut found = None;
        self.ring.take_newest(|late| {
            let first = late.bytes.first_chunk();
            found = first.map(|bytes| u32::from_le_bytes(*bytes));
        });
        found
    }

    fn draw(
        &self,
        copied: &Copied,
        suspects: &[Placed],
        drawing: &Drawing<'_>,
        clip_from_world: Mat4,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let Some(any) = drawing.any().and_then(|any| self.pipelines.of(any)) else {
            return;
        };
        let device = &self.gpu.device;
        let width = copied.texture.width();
        let Places { frame, places } = Places::new(device, clip_from_world, width, suspects);
        let depth = copied
            .texture
            .create_view(&wgpu::TextureViewDescriptor::default());
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(LABEL),
            layout: &any.get_bind_group_layout(0),
            entries: &[
                entry(0, frame.as_entire_binding()),
                entry(1, places.as_entire_binding()),
                entry(2, copied.counts.as_entire_binding()),
                entry(3, wgpu::BindingResource::TextureView(&depth)),
            ],
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(LABEL),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                // It is only read.
                depth_ops: None,
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, &group, &[]);
        drawing.record(&mut pass, &self.pipelines);
    }
}

const LABEL: &str = "antumbra: wrong pixels";

/// What the pipelines of a copy are made of.
struct CountDesc {
    shader: String,
    fragment: &'static str,
    entries: [wgpu::BindGroupLayoutEntry; 2],
}

impl CountDesc {
    fn desc(&self) -> PassDesc<'_> {
        PassDesc {
            label: LABEL,
            shader: &self.shader,
            fragment: Some(self.fragment),
            entries: &self.entries,
            depth: wgpu::CompareFunction::Always,
            writes_depth: false,
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

    fn pass_desc(&self) -> CountDesc {
        let multisampled = self.texture.sample_count() > 1;
        let (texture, fragment) = match multisampled {
            false => ("texture_depth_2d", "count_pixels"),
            true => ("texture_depth_multisampled_2d", "count_samples"),
        };
        let write = wgpu::BufferBindingType::Storage { read_only: false };
        let depth = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled,
        };
        let stage = wgpu::ShaderStages::FRAGMENT;
        CountDesc {
            shader: include_str!("wrong_pixels.wgsl").replace("DEPTH_TEXTURE", texture),
            fragment,
            entries: [entry(2, stage, buffer(write)), entry(3, stage, depth)],
        }
    }
}
