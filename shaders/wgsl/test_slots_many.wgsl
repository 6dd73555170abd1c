//!import test_slots
//!import depth_many
// Tests the boxes of slots by a depth of several samples a pixel.
