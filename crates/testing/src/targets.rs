//! A host's targets, for stages that are embedded.

use antumbra_cull::{DEPTH_FORMAT, Gpu, ImportedTargets};

/// Colour and depth textures of a host. New ones are black and infinitely far.
pub struct HostTargets {
    /// Colour.
    pub colour: wgpu::Texture,
    /// Depth.
    pub depth: wgpu::Texture,
}

impl HostTargets {
    /// Textures of this size in pixels, attachments with `further` usages.
    pub fn new(
        gpu: &Gpu,
        size: [u32; 2],
        colour: wgpu::TextureFormat,
        further: wgpu::TextureUsages,
    ) -> Self {
        let texture = |format| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("the host's"),
                size: wgpu::Extent3d {
                    width: size[0],
                    height: size[1],
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | further,
                view_formats: &[],
            })
        };
        Self {
            colour: texture(colour),
            depth: texture(DEPTH_FORMAT),
        }
    }

    /// They as a view's targets.
    pub fn imported(&self) -> ImportedTargets<'_> {
        ImportedTargets {
            colour: &self.colour,
            depth: &self.depth,
        }
    }
}
