//!import rival_slots
// The occlusion test of Bevy 0.20.1 for meshlets, as a yardstick (bevy_pbr, meshlet/cull_shared). Up to four by four loads, at the finest level at which a rectangle touches no more texels than that;
// a box across the near plane is visible; equal depth is occluded.

const PASSED_IS_VISIBLE: bool = true;

fn is_visible(place: RelativeBox) -> bool {
    let seen = seen_box(place);
    if !(seen.least_w > 0.0) || !(seen.least_gap > 0.0) {
        return true;
    }
    let edge = level_size(0u) - 1.0;
    let first = vec2<u32>(clamp(seen.low * level_size(0u), vec2<f32>(0.0), edge));
    let last = vec2<u32>(clamp(seen.high * level_size(0u), vec2<f32>(0.0), edge));
    var level = 0u;
    while any((last >> vec2<u32>(level)) - (first >> vec2<u32>(level)) > vec2<u32>(3u)) {
        level++;
    }
    var farthest = NEAREST;
    for (var y = first.y >> level; y <= last.y >> level; y++) {
        for (var x = first.x >> level; x <= last.x >> level; x++) {
            farthest = min(farthest, texel(level, vec2<i32>(i32(x), i32(y))));
        }
    }
    return !(seen.nearest <= farthest);
}
