//! Combines the pictures of two eyes: side by side, or as a red-cyan anaglyph.
//!
//! The anaglyph's matrices are those of Eric Dubois, *A projection method to generate anaglyph stereo images* (ICASSP 2001), with the
//! numbers for red-cyan glasses of his *Conversion of a Stereo Pair to Anaglyph with the Least-Squares Projection Method* (2009). They give
//! the picture that, seen through such glasses, differs least from the pair. A half-colour anaglyph (the left eye's luminance in red, the
//! right eye's green and blue) is simpler, but unsuitable for saturated colours: red is bright to the left eye and black to the right, which
//! flickers. The projection mixes such colours so that both eyes get about the same brightness, and subtracts some of the crosstalk of the
//! glasses.

use std::fmt;
use std::str::FromStr;

use image::RgbaImage;

use crate::MeasureError;

/// How the pictures of two eyes are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StereoLayout {
    /// One picture of twice the width, the left eye's on the left, for parallel viewing or a stereoscope.
    #[default]
    SideBySide,
    /// One anaglyph for glasses with red on the left and cyan on the right.
    RedCyan,
    /// One picture for each eye.
    Separate,
}

/// One picture of a layout.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StereoPicture {
    /// The suffix of its file name before the extension: `-left` or `-right`; empty where there is one picture.
    pub suffix: &'static str,
    /// The picture.
    pub picture: RgbaImage,
}

impl StereoLayout {
    /// All layouts.
    pub const ALL: [Self; 3] = [Self::SideBySide, Self::Separate, Self::RedCyan];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::SideBySide => "side-by-side",
            Self::RedCyan => "red-cyan",
            Self::Separate => "separate",
        }
    }
}

impl fmt::Display for StereoLayout {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for StereoLayout {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = Self::ALL.into_iter().find(|layout| layout.name() == text);
        known.ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            format!("the layouts are {names}")
        })
    }
}

/// Combines the pictures of two eyes into one; for [`StereoLayout::Separate`], returns both unchanged, left first.
///
/// # Errors
/// [`MeasureError::SizeMismatch`] where they differ in size.
pub fn combine_eyes(
    left: RgbaImage,
    right: RgbaImage,
    layout: StereoLayout,
) -> Result<Vec<StereoPicture>, MeasureError> {
    let mismatch = || MeasureError::SizeMismatch {
        what: "right eye's picture",
        got: format!("{} x {}", right.width(), right.height()),
        expected: format!("{} x {}", left.width(), left.height()),
    };
    if left.dimensions() != right.dimensions() {
        return Err(mismatch());
    }
    let one = |picture| StereoPicture {
        suffix: "",
        picture,
    };
    Ok(match layout {
        StereoLayout::SideBySide => vec![one(side_by_side(&left, &right).ok_or_else(mismatch)?)],
        StereoLayout::RedCyan => vec![one(red_cyan(&left, &right))],
        StereoLayout::Separate => vec![
            StereoPicture {
                suffix: "-left",
                picture: left,
            },
            StereoPicture {
                suffix: "-right",
                picture: right,
            },
        ],
    })
}

fn side_by_side(left: &RgbaImage, right: &RgbaImage) -> Option<RgbaImage> {
    let (width, height) = left.dimensions();
    let row = width as usize * 4;
    if row == 0 {
        return Some(RgbaImage::new(0, height));
    }
    let rows = left.chunks_exact(row).zip(right.chunks_exact(row));
    let bytes = rows.flat_map(|(left, right)| [left, right]).flatten();
    RgbaImage::from_raw(width.checked_mul(2)?, height, bytes.copied().collect())
}

/// Rows: red, green and blue of the anaglyph. Columns: red, green and blue of the left eye, then of the right. In linear light.
const DUBOIS: [[f32; 6]; 3] = [
    [0.437, 0.449, 0.164, -0.011, -0.032, -0.007],
    [-0.062, -0.062, -0.024, 0.377, 0.761, 0.009],
    [-0.048, -0.050, -0.017, -0.026, -0.093, 1.234],
];

fn red_cyan(left: &RgbaImage, right: &RgbaImage) -> RgbaImage {
    let linear: Vec<f32> = (0..=u8::MAX).map(decode).collect();
    let light = |value: u8| linear.get(usize::from(value)).copied().unwrap_or(0.0);
    let mut out = left.clone();
    for (pixel, right) in out.pixels_mut().zip(right.pixels()) {
        let [r, g, b, alpha] = pixel.0;
        let [r2, g2, b2, alpha2] = right.0;
        let seen = [r, g, b, r2, g2, b2].map(light);
        let [red, green, blue] = DUBOIS.map(|row| {
            let sum: f32 = row.iter().zip(seen).map(|(part, light)| part * light).sum();
            encode(sum)
        });
        pixel.0 = [red, green, blue, alpha.max(alpha2)];
    }
    out
}

/// Linear light of an sRGB byte, 0 to 1.
fn decode(value: u8) -> f32 {
    let value = f32::from(value) / 255.0;
    if value <= 0.04045 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}

/// The sRGB byte of linear light, clipped to 0 to 1.
fn encode(light: f32) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let value = if light <= 0.003_130_8 {
        light * 12.92
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    };
    (value * 255.0).round() as u8
}
