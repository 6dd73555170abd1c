// The result of a patch: one bit for each pixel, row by row, and then the number of drawn indices.

// Pixels along a side of a patch.
const PATCH: u32 = 16u;
// Words of the marks of a patch.
const MARK_WORDS: u32 = PATCH * PATCH / 32u;
// Words of a patch.
const WORDS: u32 = MARK_WORDS + 1u;

// Which of four neighbouring patches a pixel is in: the two highest bits of the patch number of a kept entry.
const PARITY: u32 = 0xc0000000u;

fn patch_parity(pixel: vec2<u32>) -> u32 {
    let odd = (pixel / PATCH) & vec2<u32>(1u);
    return (odd.x << 30u) | (odd.y << 31u);
}
