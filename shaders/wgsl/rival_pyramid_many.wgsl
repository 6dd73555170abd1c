//!import rival_pyramid
//!import depth_many
// The first level of a rival's pyramid, of a depth of several samples a pixel.
