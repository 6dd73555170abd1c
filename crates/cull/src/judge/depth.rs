//! A host's depth: its format, its samples and its direction, and the checks of the textures that are handed in.

use super::error::JudgeError;

/// In which direction depths grow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum DepthRange {
    /// 1 at the near plane: greater is nearer.
    #[default]
    Reversed,
    /// 0 at the near plane: less is nearer.
    Forward,
}

impl DepthRange {
    /// What a depth is multiplied with to grow towards the eye.
    pub(super) fn towards(self) -> f32 {
        match self {
            Self::Reversed => 1.0,
            Self::Forward => -1.0,
        }
    }
}

/// The depth textures of a host's view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HostDepth {
    /// A format with depth, with or without stencil.
    pub format: wgpu::TextureFormat,
    /// Samples a pixel.
    pub samples: u32,
    /// In which direction depths grow.
    pub range: DepthRange,
}

impl Default for HostDepth {
    /// 32-bit floats, one sample, reversed.
    fn default() -> Self {
        Self {
            format: wgpu::TextureFormat::Depth32Float,
            samples: 1,
            range: DepthRange::Reversed,
        }
    }
}

impl HostDepth {
    /// By how much a stored depth may differ from what was drawn, beyond the relative error of the maths.
    pub(super) fn step(self) -> f32 {
        use wgpu::TextureFormat as Format;
        match (self.format, self.range) {
            (Format::Depth16Unorm, _) => 1.0 / 65_535.0,
            (Format::Depth24Plus | Format::Depth24PlusStencil8, _) => 1.0 / 16_777_215.0,
            // Far away, forward depths are near 1, where floats have steps of this size.
            (_, DepthRange::Forward) => f32::EPSILON / 2.0,
            (_, DepthRange::Reversed) => 0.0,
        }
    }

    /// Why it cannot be judged by.
    pub(super) fn fault(self) -> Option<String> {
        if !self.format.has_depth_aspect() {
            return Some(format!(
                "its depth has the format {:?}, which holds no depth: give a depth format",
                self.format
            ));
        }
        (!matches!(self.samples, 1 | 2 | 4 | 8)).then(|| {
            format!(
                "its depth has {} samples a pixel: give 1, 2, 4 or 8",
                self.samples
            )
        })
    }

    /// Refuses a texture that is not what the view says.
    pub(super) fn check(
        self,
        view: &str,
        size: [u32; 2],
        texture: &wgpu::Texture,
    ) -> Result<(), JudgeError> {
        let fault = |why: String| {
            Err(JudgeError::Depth {
                view: view.to_owned(),
                why,
            })
        };
        let found = [texture.width(), texture.height()];
        if found != size {
            return fault(format!(
                "has {} x {} pixels, and the view {} x {}: call `Judge::resize` when the view's size changes",
                found[0], found[1], size[0], size[1]
            ));
        }
        if texture.format() != self.format {
            return fault(format!(
                "is {:?}, and the view says {:?}: name the texture's format in `JudgeView::depth`",
                texture.format(),
                self.format
            ));
        }
        if texture.sample_count() != self.samples {
            return fault(format!(
                "has {} samples a pixel, and the view says {}: name the texture's samples in `JudgeView::depth`",
                texture.sample_count(),
                self.samples
            ));
        }
        if texture.depth_or_array_layers() != 1 || texture.mip_level_count() != 1 {
            return fault("has layers or mips: give a texture with one of each".to_owned());
        }
        if !texture
            .usage()
            .contains(wgpu::TextureUsages::TEXTURE_BINDING)
        {
            return fault("lacks the usage TEXTURE_BINDING: create the texture with it".to_owned());
        }
        Ok(())
    }
}
