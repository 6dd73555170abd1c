//! Pictures into PNG files.

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, RgbaImage};

use crate::MeasureError;
use crate::store::write_beside;

/// Writes a picture as a PNG, beside and renamed into place.
///
/// # Errors
/// When it cannot be encoded or written; nothing is left behind then.
pub fn save_png(picture: &RgbaImage, path: &Path) -> Result<(), MeasureError> {
    let mut bytes = Vec::new();
    picture
        .write_to(&mut Cursor::new(&mut bytes), ImageFormat::Png)
        .map_err(|source| MeasureError::Image {
            path: path.to_owned(),
            source,
        })?;
    write_beside(path, &bytes)
}
