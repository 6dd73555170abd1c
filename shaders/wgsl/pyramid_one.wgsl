//!import reduce
//!import depth_one
// The first levels of the pyramid of a depth of one sample a pixel.
