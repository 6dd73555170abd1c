//!import judge
//!import depth_one
// Judges instances by a depth of one sample a pixel.
