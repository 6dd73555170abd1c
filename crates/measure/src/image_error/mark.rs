//! Marks wrong pixels: the frame in grey, wrong pixels in magenta, with a halo so that a single pixel of a large frame is visible.

use image::{Rgba, RgbaImage};

use crate::MeasureError;

const WRONG: [u8; 3] = [255, 0, 255];

/// The image desaturated and dimmed, with wrong pixels in magenta and a paler halo around them. The halo's size grows with the image, so that a
/// single wrong pixel is visible in a thumbnail of 128 pixels.
///
/// `mask` has a flag for each pixel, row by row from the top left, as from the oracle.
///
/// # Errors
/// [`MeasureError::SizeMismatch`] where the mask and the image differ in their number of pixels.
pub fn mark_wrong(image: &RgbaImage, mask: &[bool]) -> Result<RgbaImage, MeasureError> {
    let (width, height) = image.dimensions();
    let pixels = width as usize * height as usize;
    if mask.len() != pixels {
        return Err(MeasureError::SizeMismatch {
            what: "mask of wrong pixels",
            got: format!("{} pixels", mask.len()),
            expected: format!("{pixels} pixels"),
        });
    }
    let radius = (width.max(height) as usize).div_ceil(160);
    let halo = dilate(mask, width as usize, radius);
    let mut marked = image.clone();
    for ((pixel, &wrong), &near) in marked.pixels_mut().zip(mask).zip(&halo) {
        let grey = dimmed(*pixel);
        let rgb = match (wrong, near) {
            (true, _) => WRONG,
            (false, true) => WRONG.map(|c| ((3 * u16::from(c) + u16::from(grey)) / 4) as u8),
            (false, false) => [grey; 3],
        };
        *pixel = Rgba([rgb[0], rgb[1], rgb[2], 255]);
    }
    Ok(marked)
}

/// Rec. 709 luma, compressed into the middle of the scale so that magenta stands out from black and from white.
fn dimmed(Rgba([r, g, b, _]): Rgba<u8>) -> u8 {
    let luma = (u32::from(r) * 54 + u32::from(g) * 183 + u32::from(b) * 19) / 256;
    (40 + luma * 160 / 255) as u8
}

/// Dilates by a square, one direction after the other.
fn dilate(mask: &[bool], width: usize, radius: usize) -> Vec<bool> {
    if width == 0 {
        return Vec::new();
    }
    let height = mask.len() / width;
    let mut rows = vec![false; mask.len()];
    for (from, to) in mask.chunks(width).zip(rows.chunks_mut(width)) {
        spread(from.iter().copied(), radius, |x| {
            if let Some(cell) = to.get_mut(x) {
                *cell = true;
            }
        });
    }
    let mut out = vec![false; mask.len()];
    for x in 0..width {
        let column = rows.iter().skip(x).step_by(width).copied();
        spread(column, radius, |y| {
            if y < height
                && let Some(cell) = out.get_mut(y * width + x)
            {
                *cell = true;
            }
        });
    }
    out
}

/// Calls `set` with every index within `radius` of a `true`, each at most once; indices may be past the end.
fn spread(line: impl Iterator<Item = bool>, radius: usize, mut set: impl FnMut(usize)) {
    let mut done = 0;
    for (i, _) in line.enumerate().filter(|(_, wrong)| *wrong) {
        for at in done.max(i.saturating_sub(radius))..=i + radius {
            set(at);
        }
        done = i + radius + 1;
    }
}
