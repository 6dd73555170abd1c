//!import test_slots
// Tests the boxes of all slots against an earlier frame's pyramid, from that frame's view. The depth itself is gone, so that the finest level of the pyramid decides.

fn nearness(pixel: vec2<u32>) -> f32 {
    let row = pyramid.levels[2];
    let at = pixel >> vec2<u32>(2u);
    return texels[row.x + at.y * row.y + at.x];
}
