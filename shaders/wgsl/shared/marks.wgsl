// The result of a patch: one bit for each pixel, row by row, and then the number of drawn indices.

// Pixels along a side of a patch.
const PATCH: u32 = 16u;
// Words of the marks of a patch.
const MARK_WORDS: u32 = PATCH * PATCH / 32u;
// Words of a patch.
const WORDS: u32 = MARK_WORDS + 1u;
