// A depth of several samples a pixel. It is bound as floats: GL cannot load from depth textures.
@group(0) @binding(7) var depth: texture_multisampled_2d<f32>;

// The nearness of the farthest sample of a pixel; the pixel must be on the image.
fn nearness(at: vec2<u32>) -> f32 {
    var least = NEAREST;
    for (var number = 0u; number < pyramid.samples; number++) {
        least = min(least, pyramid.towards * textureLoad(depth, at, number).x);
    }
    return least;
}
