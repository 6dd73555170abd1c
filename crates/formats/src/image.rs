//! Decoding of images.

use crate::budget::Budget;
use crate::error::LoadProblem;
use antumbra_scene::{Image, ImageKey, Sampler, Scene};

/// Decodes a PNG or JPEG and adds it to the scene.
pub(super) fn add_image(
    scene: &mut Scene,
    place: &str,
    name: String,
    bytes: &[u8],
    sampler: Sampler,
    budget: &mut Budget,
) -> Result<ImageKey, LoadProblem> {
    let bad = |problem: String| LoadProblem::BadImage {
        image: place.to_owned(),
        problem,
    };
    let open = || {
        let cursor = std::io::Cursor::new(bytes);
        image::ImageReader::new(cursor).with_guessed_format()
    };
    let size = open().map_err(|e| bad(e.to_string()))?.into_dimensions();
    let (width, height) = size.map_err(|e| bad(e.to_string()))?;
    let pixels = u64::from(width) * u64::from(height);
    budget.enter(place);
    budget.pixels(pixels)?;
    let mut reader = open().map_err(|e| bad(e.to_string()))?;
    let mut limits = image::Limits::default();
    // Sixteen bits per channel, and the decoder's own copy.
    limits.max_alloc = Some(pixels.saturating_mul(16).saturating_add(1 << 24));
    reader.limits(limits);
    let decoded = reader.decode().map_err(|e| bad(e.to_string()))?;
    let rgba = decoded.into_rgba8();
    let image = Image {
        name,
        width: rgba.width(),
        height: rgba.height(),
        rgba: rgba.into_raw(),
        sampler,
    };
    Ok(scene.add_image(image)?)
}
