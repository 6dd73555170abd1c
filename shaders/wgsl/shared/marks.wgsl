// What is known of a patch once it was drawn into: a bit a pixel, row by row, and then how many indices were drawn.

// Pixels along a side of a patch.
const PATCH: u32 = 16u;
const MARK_WORDS: u32 = PATCH * PATCH / 32u;
const WORDS: u32 = MARK_WORDS + 1u;
