//! KTX2 images compressed with Basis Universal (ETC1S or UASTC; Binomial and the Khronos Group), decoded by the crate `basisu`.

use crate::budget::Budget;
use crate::error::LoadProblem;
use basisu::{DecodeFlags, TargetFormat, Transcoder};
use image::RgbaImage;

/// The places of numbers in the header, and the bytes of a block of 4 x 4 pixels.
const WIDTH: usize = 20;
const HEIGHT: usize = 24;
const UNCOMPRESSED_LENGTH: usize = 80 + 16;
const BLOCK: u64 = 16;

/// Decodes the largest level; `None` where the crate cannot.
///
/// # Errors
/// What exceeds the budget, before it is allocated.
pub(crate) fn decode(bytes: &[u8], budget: &mut Budget) -> Result<Option<RgbaImage>, LoadProblem> {
    let number = |at: usize| {
        bytes
            .get(at..)?
            .first_chunk()
            .copied()
            .map(u32::from_le_bytes)
    };
    let length = bytes.get(UNCOMPRESSED_LENGTH..);
    let length = length.and_then(|bytes| bytes.first_chunk().copied().map(u64::from_le_bytes));
    let (Some(width), Some(height), Some(length)) = (number(WIDTH), number(HEIGHT), length) else {
        return Ok(None);
    };
    let blocks = u64::from(width.div_ceil(4)) * u64::from(height.div_ceil(4));
    if length > blocks * BLOCK {
        // A level that says it is larger than its pixels.
        return Ok(None);
    }
    budget.pixels(u64::from(width) * u64::from(height))?;
    // The blocks, while they become pixels.
    budget.memory(blocks * BLOCK)?;
    let decoded = Transcoder::new(bytes)
        .and_then(|transcoder| transcoder.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE));
    Ok(decoded
        .ok()
        .and_then(|pixels| RgbaImage::from_raw(width, height, pixels)))
}
