//!import retest_slots
//!import depth_many
// Tests what was drawn once more, by a depth of several samples a pixel.
