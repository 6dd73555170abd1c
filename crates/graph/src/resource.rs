//! Resources: the descriptions of textures and buffers, and how the graph records them.

use std::any::Any;

/// The value to which the first writer of a frame clears a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clear {
    /// For a colour target. Channels of integer formats are given as whole numbers.
    Colour(wgpu::Color),
    /// For a depth target. With reversed depth, 0 is the far plane.
    Depth(f32),
    /// For a target with depth and stencil.
    DepthStencil(f32, u32),
}

/// A two-dimensional texture, possibly with layers, mips and samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureDesc {
    /// Width in texels, at least 1.
    pub width: u32,
    /// Height in texels, at least 1.
    pub height: u32,
    /// Array layers, at least 1.
    pub layers: u32,
    /// Mip levels, at least 1.
    pub mips: u32,
    /// Samples a texel: 1, or another count that the format allows.
    pub samples: u32,
    /// The texel format.
    pub format: wgpu::TextureFormat,
    /// The value to which the first writer of a frame clears it; with `None`, its contents are undefined for the first writer.
    pub clear: Option<Clear>,
}

impl TextureDesc {
    /// One layer, one mip, one sample, not cleared.
    #[must_use]
    pub const fn new(width: u32, height: u32, format: wgpu::TextureFormat) -> Self {
        Self {
            width,
            height,
            layers: 1,
            mips: 1,
            samples: 1,
            format,
            clear: None,
        }
    }

    /// Cleared by the first writer of a frame.
    #[must_use]
    pub const fn cleared(mut self, clear: Clear) -> Self {
        self.clear = Some(clear);
        self
    }

    /// With that many array layers.
    #[must_use]
    pub const fn layers(mut self, layers: u32) -> Self {
        self.layers = layers;
        self
    }

    /// With that many mip levels.
    #[must_use]
    pub const fn mips(mut self, mips: u32) -> Self {
        self.mips = mips;
        self
    }

    /// With that many samples a texel.
    #[must_use]
    pub const fn samples(mut self, samples: u32) -> Self {
        self.samples = samples;
        self
    }

    /// Bytes of one instance, all mips, layers and samples, as wgpu estimates them.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        (0..self.mips.min(32))
            .map(|mip| {
                self.format
                    .theoretical_memory_footprint(wgpu::Extent3d {
                        width: (self.width >> mip).max(1),
                        height: (self.height >> mip).max(1),
                        depth_or_array_layers: self.layers,
                    })
                    .saturating_mul(u64::from(self.samples))
            })
            .sum()
    }

    /// Whether two descriptions may share one wgpu texture, which has no clear value.
    pub(crate) fn same_object(&self, other: &Self) -> bool {
        Self {
            clear: None,
            ..*self
        } == Self {
            clear: None,
            ..*other
        }
    }

    /// The declared clear value, or transparent black.
    pub(crate) fn colour_clear(&self) -> wgpu::Color {
        match self.clear {
            Some(Clear::Colour(colour)) => colour,
            _ => wgpu::Color::TRANSPARENT,
        }
    }

    pub(crate) fn depth_clear(&self) -> f32 {
        match self.clear {
            Some(Clear::Depth(depth) | Clear::DepthStencil(depth, _)) => depth,
            _ => 0.0,
        }
    }

    pub(crate) fn stencil_clear(&self) -> u32 {
        match self.clear {
            Some(Clear::DepthStencil(_, stencil)) => stencil,
            _ => 0,
        }
    }
}

/// A buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BufferDesc {
    /// Size in bytes, at least 1. The graph rounds up to a multiple of 4. For an import, the least size that is accepted.
    pub size: u64,
    /// It is cleared to zero before its first write of a frame.
    pub zeroed: bool,
}

impl BufferDesc {
    /// `size` bytes, contents undefined before the first write of a frame.
    #[must_use]
    pub const fn new(size: u64) -> Self {
        Self {
            size,
            zeroed: false,
        }
    }

    /// Cleared to zero before its first write of a frame.
    #[must_use]
    pub const fn zeroed(mut self) -> Self {
        self.zeroed = true;
        self
    }

    pub(crate) fn rounded(&self) -> u64 {
        self.size.saturating_add(3) & !3
    }
}

/// How the store creates and empties the value of a host resource.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HostType {
    pub make: fn() -> Box<dyn Any + Send>,
    pub empty: fn(&mut (dyn Any + Send)),
    pub is_set: fn(&(dyn Any + Send)) -> bool,
}

/// The kind of a resource with its description.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    Texture(TextureDesc),
    Buffer(BufferDesc),
    Host(HostType),
}

/// A resource as declared.
#[derive(Clone, Debug)]
pub(crate) struct Resource {
    pub name: String,
    pub kind: Kind,
    pub import: bool,
}
