//!import cull_patches
// Culls entries of patches by a finished depth of several samples a pixel.

@group(0) @binding(3) var finished_depth: texture_multisampled_2d<f32>;

fn farthest(at: vec2<u32>) -> f32 {
    var least = textureLoad(finished_depth, at, 0u).x;
    for (var number = 1u; number < settings.samples; number++) {
        least = min(least, textureLoad(finished_depth, at, number).x);
    }
    return least;
}
