//! FLIP, a perceptual difference of two images that are viewed in alternation.
//!
//! Pontus Andersson, Jim Nilsson, Tomas Akenine-Moller, Magnus Oskarsson, Kalle Astrom, Mark D. Fairchild: "FLIP: A Difference Evaluator for
//! Alternating Images", 2020. The implementation is theirs too, by way of `nv-flip`.

use image::RgbaImage;
use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8};

use crate::MeasureError;

/// The FLIP difference of two images.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Flip {
    /// The mean over all pixels, 0 (equal) to 1.
    pub mean: f64,
    /// The largest of all pixels, 0 to 1.
    pub max: f64,
}

/// The FLIP difference of two sRGB images at the usual 67 pixels a degree. Alpha is ignored.
///
/// The difference of images that are equal in every byte is exactly 0, which FLIP's arithmetic would only approach.
///
/// # Errors
/// [`MeasureError::SizeMismatch`] where the images differ in size.
pub fn flip(reference: &RgbaImage, image: &RgbaImage) -> Result<Flip, MeasureError> {
    if reference.dimensions() != image.dimensions() {
        return Err(MeasureError::SizeMismatch {
            what: "image to compare by FLIP",
            got: format!("{:?} pixels", image.dimensions()),
            expected: format!("{:?} pixels", reference.dimensions()),
        });
    }
    if reference.as_raw() == image.as_raw() {
        return Ok(Flip::default());
    }
    let (reference, image) = (rgb(reference), rgb(image));
    let map = nv_flip::flip(reference, image, DEFAULT_PIXELS_PER_DEGREE).to_vec();
    let (sum, max) = map.iter().fold((0.0f64, 0.0f32), |(sum, max), e| {
        (sum + f64::from(*e), max.max(*e))
    });
    Ok(Flip {
        mean: sum / map.len() as f64,
        max: f64::from(max),
    })
}

fn rgb(image: &RgbaImage) -> FlipImageRgb8 {
    let bytes: Vec<u8> = image
        .pixels()
        .flat_map(|p| [p.0[0], p.0[1], p.0[2]])
        .collect();
    FlipImageRgb8::with_data(image.width(), image.height(), &bytes)
}
