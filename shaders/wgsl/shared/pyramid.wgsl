// A depth pyramid: for each block of 2^level x 2^level pixels, aligned to the upper left corner, the nearness of its farthest sample. A texel stands
// for its block exactly, at any size of the image: none is missed, and none beside it is read.
//
// Levels 2 and up lie one after the other in a buffer. Levels 0 and 1 are not kept: the depth itself is read instead.

struct Pyramid {
    width: u32,
    height: u32,
    samples: u32,
    // As in `JudgedView`.
    towards: f32,
    // Number of levels, those that are not kept included.
    count: u32,
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
    // By level: the first texel, and the width and height in texels.
    levels: array<vec4<u32>, 16>,
}

// Nearer than any depth: what blocks at the edge have instead of the pixels beyond it.
const NEAREST: f32 = 2.0;
