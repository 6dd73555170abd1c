//! Decoding of images. An image costs no shape: one that cannot be had is left out, and the load says so.

use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::file_resolver::Found;
use crate::left_out::LostPart;
use antumbra_scene::{Image, ImageKey, Sampler, Scene};
use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

/// What an image is for.
pub(super) struct ImageSource<'a> {
    /// Its place in the file, for messages.
    pub(super) place: &'a str,
    /// The name it keeps.
    pub(super) name: &'a str,
    /// The name of its file, if it has one.
    pub(super) file: &'a str,
    /// How it is sampled.
    pub(super) sampler: Sampler,
}

/// Why an image was not decoded.
enum Undecoded {
    /// The reason, in a word or two.
    Unread(&'static str),
    /// It exceeds a limit of the load.
    Limit(LoadProblem),
}

/// Adds an image that a reference led to, or notes why it is left out.
///
/// # Errors
/// What exceeds the budget.
pub(super) fn add_found(
    scene: &mut Scene,
    found: Found,
    source: &ImageSource<'_>,
    budget: &mut Budget,
) -> Result<Option<ImageKey>, LoadProblem> {
    match found {
        Found::Bytes(bytes) => add(scene, &bytes, source, budget),
        Found::Missing(reason) => {
            let example = format!("{}: \"{}\"", source.place, source.file);
            budget.left_out.add(LostPart::Image, reason, &example);
            Ok(None)
        }
    }
}

/// Decodes an image and adds it to the scene, or notes why it is left out.
///
/// # Errors
/// What exceeds the budget.
pub(super) fn add(
    scene: &mut Scene,
    bytes: &[u8],
    source: &ImageSource<'_>,
    budget: &mut Budget,
) -> Result<Option<ImageKey>, LoadProblem> {
    budget.enter(source.place);
    let (width, height, rgba) = match decode(bytes, source.file, budget) {
        Ok(decoded) => (decoded.width(), decoded.height(), decoded.into_rgba8()),
        Err(Undecoded::Limit(problem)) => return Err(problem),
        Err(Undecoded::Unread(reason)) => {
            budget.left_out.add(LostPart::Image, reason, source.place);
            return Ok(None);
        }
    };
    budget.name(source.name)?;
    let image = Image {
        name: source.name.to_owned(),
        width,
        height,
        rgba: rgba.into_raw(),
        sampler: source.sampler,
    };
    Ok(Some(scene.add_image(image)?))
}

fn decode(bytes: &[u8], name: &str, budget: &mut Budget) -> Result<DynamicImage, Undecoded> {
    let format = match format(bytes, name) {
        Some(Format::Known(format)) => format,
        #[cfg(feature = "basisu")]
        Some(Format::Ktx2) => {
            return match crate::ktx2::decode(bytes, budget) {
                Ok(Some(image)) => Ok(DynamicImage::ImageRgba8(image)),
                Ok(None) => Err(Undecoded::Unread("KTX2 that cannot be decoded")),
                Err(problem) => Err(Undecoded::Limit(problem)),
            };
        }
        #[cfg(not(feature = "basisu"))]
        Some(Format::Ktx2) => return Err(Undecoded::Unread("KTX2")),
        Some(Format::Named(name)) => return Err(Undecoded::Unread(name)),
        None => return Err(Undecoded::Unread("an unknown format")),
    };
    if !format.reading_enabled() {
        return Err(Undecoded::Unread(match format {
            ImageFormat::WebP => "WebP",
            ImageFormat::Gif => "GIF",
            ImageFormat::Tiff => "TIFF",
            ImageFormat::Dds => "DDS",
            ImageFormat::Avif => "AVIF",
            _ => "an unknown format",
        }));
    }
    let open = || ImageReader::with_format(Cursor::new(bytes), format);
    let broken = || Undecoded::Unread("it cannot be decoded");
    let (width, height) = open().into_dimensions().map_err(|_| broken())?;
    let pixels = u64::from(width) * u64::from(height);
    budget.pixels(pixels).map_err(Undecoded::Limit)?;
    let mut reader = open();
    let mut limits = Limits::default();
    // Sixteen bits per channel, and the decoder's own copy.
    limits.max_alloc = Some(pixels.saturating_mul(16).saturating_add(1 << 24));
    reader.limits(limits);
    reader.decode().map_err(|_| broken())
}

/// An image's format.
enum Format {
    /// One that the crate `image` knows, if not always reads.
    Known(ImageFormat),
    /// Khronos's container of compressed textures.
    Ktx2,
    /// One that is not read.
    Named(&'static str),
}

/// The format by the first bytes; Targa, which has no mark, by its name.
fn format(bytes: &[u8], name: &str) -> Option<Format> {
    if bytes.starts_with(b"\xabKTX 20\xbb\r\n\x1a\n") {
        return Some(Format::Ktx2);
    }
    if bytes.starts_with(b"\xabKTX 11\xbb\r\n\x1a\n") {
        return Some(Format::Named("KTX"));
    }
    if bytes.starts_with(b"sB") {
        return Some(Format::Named("Basis"));
    }
    if let Ok(format) = image::guess_format(bytes) {
        return Some(Format::Known(format));
    }
    let is_targa = name.to_ascii_lowercase().ends_with(".tga");
    is_targa.then_some(Format::Known(ImageFormat::Tga))
}
