//!import cull_patches
// Culls entries of patches by a finished depth of one sample a pixel.

// A plain float texture, not a depth texture: GL cannot load from depth textures.
@group(0) @binding(3) var finished_depth: texture_2d<f32>;

fn farthest(at: vec2<u32>) -> f32 {
    return textureLoad(finished_depth, at, 0).x;
}
