// An entity id in a texture of two 16-bit channels: unlike one of 32-bit integers, such a texture may have several samples a pixel.

// The low half, then the high half.
fn packed_id(id: u32) -> vec2<u32> {
    return vec2<u32>(id & 0xffffu, id >> 16u);
}

fn unpacked_id(texel: vec4<u32>) -> u32 {
    return texel.x | (texel.y << 16u);
}
