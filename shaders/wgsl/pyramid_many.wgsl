//!import reduce
//!import depth_many
// The first levels of the pyramid of a depth of several samples a pixel.
