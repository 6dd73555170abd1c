//! The wgpu objects of a plan, and which resource uses which object.

use crate::resource::{Kind, Resource, TextureDesc};

/// The slot of a resource without an object, because it is pruned.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// A resource and the objects that it uses: two where it keeps a history, the same one twice otherwise.
pub(crate) struct Placed {
    pub resource: Resource,
    pub slots: [u32; 2],
    pub texture_usages: wgpu::TextureUsages,
    pub buffer_usages: wgpu::BufferUsages,
    /// A kept pass uses it.
    pub used: bool,
    /// Readable after the frame.
    pub output: bool,
    /// Its contents are read in the next frame: as a previous value, or by an update.
    pub history: bool,
}

impl Placed {
    /// Bytes of a buffer as declared.
    pub fn bytes(&self) -> u64 {
        match self.resource.kind {
            Kind::Buffer(desc) => desc.rounded(),
            _ => 0,
        }
    }

    /// The object of a frame's value.
    pub fn slot(&self, frame: u64) -> u32 {
        self.slots[(frame % 2) as usize]
    }

    /// The object of the value of the frame before it.
    pub fn previous_slot(&self, frame: u64) -> u32 {
        self.slots[1 - (frame % 2) as usize]
    }
}

/// A texture and its views.
pub(crate) struct PhysicalTexture {
    pub texture: wgpu::Texture,
    pub desc: TextureDesc,
    /// All mips and layers, for shaders.
    pub sampled: wgpu::TextureView,
    /// One mip and layer each, for attachments, mip by mip.
    parts: Vec<wgpu::TextureView>,
    /// The same for shaders, where that differs (depth with stencil).
    sampled_parts: Vec<wgpu::TextureView>,
}

impl PhysicalTexture {
    pub fn create(
        device: &wgpu::Device,
        label: &str,
        desc: TextureDesc,
        usage: wgpu::TextureUsages,
    ) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width: desc.width,
                height: desc.height,
                depth_or_array_layers: desc.layers,
            },
            mip_level_count: desc.mips,
            sample_count: desc.samples,
            dimension: wgpu::TextureDimension::D2,
            format: desc.format,
            usage,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self::from_parts(texture, view, desc)
    }

    /// For an import: `view` is the caller's view of the whole texture.
    pub fn from_parts(texture: wgpu::Texture, view: wgpu::TextureView, desc: TextureDesc) -> Self {
        let combined = desc.format.is_combined_depth_stencil_format();
        let aspect = if combined {
            wgpu::TextureAspect::DepthOnly
        } else {
            wgpu::TextureAspect::All
        };
        let part = |mip, layer, aspect| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                aspect,
                base_mip_level: mip,
                mip_level_count: Some(1),
                base_array_layer: layer,
                array_layer_count: Some(1),
                ..Default::default()
            })
        };
        let each_part = |aspect| -> Vec<_> {
            (0..desc.mips)
                .flat_map(|mip| (0..desc.layers).map(move |layer| (mip, layer)))
                .map(|(mip, layer)| part(mip, layer, aspect))
                .collect()
        };
        let simple = desc.mips == 1 && desc.layers == 1;
        let parts = if simple {
            vec![view.clone()]
        } else {
            each_part(wgpu::TextureAspect::All)
        };
        let sampled_parts = if combined {
            each_part(aspect)
        } else {
            Vec::new()
        };
        let sampled = if combined {
            texture.create_view(&wgpu::TextureViewDescriptor {
                aspect,
                ..Default::default()
            })
        } else {
            view
        };
        Self {
            texture,
            desc,
            sampled,
            parts,
            sampled_parts,
        }
    }

    /// One mip and layer, for an attachment.
    pub fn part(&self, mip: u32, layer: u32) -> Option<&wgpu::TextureView> {
        self.parts.get(self.part_index(mip, layer)?)
    }

    /// One mip and layer, for a shader.
    pub fn sampled_part(&self, mip: u32, layer: u32) -> Option<&wgpu::TextureView> {
        let parts = if self.sampled_parts.is_empty() {
            &self.parts
        } else {
            &self.sampled_parts
        };
        parts.get(self.part_index(mip, layer)?)
    }

    fn part_index(&self, mip: u32, layer: u32) -> Option<usize> {
        (mip < self.desc.mips && layer < self.desc.layers)
            .then_some((mip * self.desc.layers + layer) as usize)
    }
}

/// All objects of a plan. Imports are `None` until they are bound.
#[derive(Default)]
pub(crate) struct Physical {
    pub textures: Vec<Option<PhysicalTexture>>,
    pub buffers: Vec<Option<wgpu::Buffer>>,
}

impl Physical {
    pub fn texture(&self, slot: u32) -> Option<&PhysicalTexture> {
        self.textures.get(slot as usize)?.as_ref()
    }

    pub fn buffer(&self, slot: u32) -> Option<&wgpu::Buffer> {
        self.buffers.get(slot as usize)?.as_ref()
    }
}
