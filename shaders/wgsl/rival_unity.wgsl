//!import rival_slots
// The newest occlusion test of Unity's GPU Resident Drawer, as a yardstick (OcclusionCullingCommon.hlsl). Eight corners give a rectangle; four texels around its middle are read, at a level for its
// larger side, or one coarser where they would not cover it; the depth is first drawn 1/256 towards the camera, so that a flat box is not hidden by what is in it.

const PASSED_IS_VISIBLE: bool = true;
const SLACK: f32 = 1.0 / 256.0;
// Level 0 has a texel for this many pixels a side.
const PIXELS: f32 = 8.0;

// The first of the four texels that are read around a place.
fn footprint(level: u32, at: vec2<f32>) -> vec2<f32> {
    return floor(clamp(at, vec2<f32>(0.5), level_size(level) - 0.5) - 0.5);
}

fn is_visible(place: RelativeBox) -> bool {
    let seen = seen_box(place);
    if !(seen.least_w > 1e-6) || !(seen.most_z < 0.0) {
        return true;
    }
    let scale = vec2<f32>(view.pixels_wide, view.pixels_high) / PIXELS;
    let middle = (seen.low + seen.high) * 0.5 * scale;
    let half = (seen.high - seen.low) * 0.5 * scale;
    // The exponent that takes the mantissa of half the larger side below 1.
    let larger = max(half.x, half.y);
    var level = 0u;
    while larger >= f32(1u << level) && level < 16u {
        level++;
    }
    if level < pyramid.count {
        let shrunk = 1.0 / f32(1u << level);
        let first = footprint(level, middle * shrunk);
        if any((middle - half) * shrunk < first) || any(first + 2.0 < (middle + half) * shrunk) {
            level++;
        }
    }
    // Too large for the levels there are.
    if level >= pyramid.count {
        return true;
    }
    let depth = drawn_towards_camera(seen.nearest);
    return depth > farthest_of_four(level, vec2<i32>(footprint(level, middle / f32(1u << level))));
}

// In perspective the distance from the eye becomes smaller by the slack. In a parallel view the distance from the near plane does: what Unity does there is not known here.
fn drawn_towards_camera(depth: f32) -> f32 {
    let parallel = view.clip_from_view[2].w == 0.0;
    return select(depth / (1.0 - SLACK), 1.0 - (1.0 - depth) * (1.0 - SLACK), parallel);
}
