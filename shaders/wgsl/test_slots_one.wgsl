//!import test_slots
//!import depth_one
// Tests the boxes of slots by a depth of one sample a pixel.
