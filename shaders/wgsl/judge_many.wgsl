//!import judge
//!import depth_many
// Judges instances by a depth of several samples a pixel.
