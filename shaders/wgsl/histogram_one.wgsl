//!import histogram
// Counts visible samples in an entity-id buffer of one sample a pixel.

@group(0) @binding(0) var ids: texture_2d<u32>;

fn texel(at: vec2<u32>, number: u32) -> vec4<u32> {
    return textureLoad(ids, at, 0);
}
