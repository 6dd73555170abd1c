//!import rival_slots
// The occlusion test of Bevy 0.20.1 for meshes, as a yardstick (bevy_pbr, mesh_preprocess and occlusion_culling). Eight corners give a rectangle; four loads at the level at which its larger side
// is at most one texel; the nearest depth comes from the greatest z in view space, which is clamped to the near plane as an entry of the matrix has it.

// What passes last frame's test is drawn and not tested again.
const PASSED_IS_VISIBLE: bool = true;

// A load beyond the image's edge answers 0, which is infinitely far.
fn loaded(level: u32, at: vec2<u32>) -> f32 {
    let place = pyramid.levels[level];
    if any(at >= place.yz) {
        return 0.0;
    }
    return texels[place.x + at.y * place.y + at.x];
}

fn is_visible(place: RelativeBox) -> bool {
    let seen = seen_box(place);
    let extent = (seen.high - seen.low) * level_size(0u);
    let level = level_for(max(extent.x, extent.y));
    if level >= pyramid.count {
        return true;
    }
    // For a perspective view this entry is the near plane's distance. For others it is not.
    let nearest_z = min(-view.clip_from_view[3].z, seen.most_z);
    let clip = view.clip_from_view * vec4<f32>(0.0, 0.0, nearest_z, 1.0);
    let at = vec2<u32>(clamp(seen.low * level_size(level), vec2<f32>(0.0), level_size(level)));
    let upper = min(loaded(level, at), loaded(level, at + vec2<u32>(1u, 0u)));
    let lower = min(loaded(level, at + vec2<u32>(0u, 1u)), loaded(level, at + vec2<u32>(1u, 1u)));
    return !(clip.z / clip.w < min(upper, lower));
}
