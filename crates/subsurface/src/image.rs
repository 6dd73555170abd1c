//! Images of sections.

use antumbra_scene::{Image, Sampler, Wrap};

/// An image with clamped borders.
pub(crate) fn clamped_image([width, height]: [u32; 2], rgba: Vec<u8>) -> Image {
    Image {
        name: String::new(),
        width,
        height,
        rgba,
        sampler: Sampler {
            wrap_u: Wrap::Clamp,
            wrap_v: Wrap::Clamp,
            ..Sampler::default()
        },
    }
}
