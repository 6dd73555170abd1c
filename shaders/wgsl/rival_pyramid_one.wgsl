//!import rival_pyramid
//!import depth_one
// The first level of a rival's pyramid, of a depth of one sample a pixel.
