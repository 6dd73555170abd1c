//!import retest_slots
//!import depth_one
// Tests what was drawn once more, by a depth of one sample a pixel.
