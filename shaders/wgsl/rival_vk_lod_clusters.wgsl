//!import rival_slots
// The occlusion test of nvpro's vk_lod_clusters, as a yardstick (culling.glsl). Eight corners give a rectangle, which is scaled and clamped to the part of the pyramid in use; one sample at its middle
// through a sampler with minimum reduction, at niagara's finer level where that suffices; the nearest depth is nudged by two steps of 24 bits.

const PASSED_IS_VISIBLE: bool = true;
const NUDGE: f32 = 2.0 / 16777216.0;

fn is_visible(place: RelativeBox) -> bool {
    let seen = seen_box(place);
    // Across the near plane or the eye there is no test.
    if !(seen.least_w > 0.0) || !(seen.least_gap >= 0.0) {
        return true;
    }
    // A texel stands for two by two pixels, in a square of a power of two.
    let side = level_size(0u);
    let used = floor(vec2<f32>(view.pixels_wide, view.pixels_high) / 2.0);
    let end = (used - 2.0) / side;
    let low = min(clamp(seen.low, vec2<f32>(0.0), vec2<f32>(1.0)) * used / side, end);
    let high = min(clamp(seen.high, vec2<f32>(0.0), vec2<f32>(1.0)) * used / side, end);
    let extent = (high - low) * side;
    var level = min(level_for(max(extent.x, extent.y)), pyramid.count - 1u);
    if level > 0u && fits_four(level - 1u, low, high) {
        level -= 1u;
    }
    return seen.nearest >= sampled_farthest(level, (low + high) * 0.5) - NUDGE;
}
