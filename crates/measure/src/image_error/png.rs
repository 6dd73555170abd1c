//! Encodes pictures as PNG files and as data URIs.

use std::io::Cursor;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::{ImageFormat, RgbaImage};

use crate::MeasureError;
use crate::files::write_whole;

/// Writes a picture as a PNG file, atomically.
///
/// # Errors
/// [`MeasureError`] where it cannot be encoded or written. No file is left behind then.
pub fn save_png(picture: &RgbaImage, path: &Path) -> Result<(), MeasureError> {
    write_whole(path, &encode_png(picture, path)?)
}

/// The bytes of a PNG file. `path` is for the error.
///
/// # Errors
/// [`MeasureError::Image`] where it cannot be encoded.
pub fn encode_png(picture: &RgbaImage, path: &Path) -> Result<Vec<u8>, MeasureError> {
    let mut bytes = Vec::new();
    picture
        .write_to(&mut Cursor::new(&mut bytes), ImageFormat::Png)
        .map_err(|source| MeasureError::Image {
            path: path.to_owned(),
            source,
        })?;
    Ok(bytes)
}

/// A file's bytes as a data URI.
pub(crate) fn data_uri(mime: &str, bytes: &[u8]) -> String {
    format!("data:{mime};base64,{}", STANDARD.encode(bytes))
}
