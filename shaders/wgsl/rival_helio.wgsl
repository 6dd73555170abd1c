//!import rival_slots
// Helio's occlusion test, as a yardstick (helio-pass-occlusion-cull). A sphere's rectangle is taken to be its middle and its radius over w; four points of it are sampled; the depth is that of the
// sphere's point nearest to the eye. Helio's depth is forward: its bias of 1/65,536 is the same step in reversed depth.

// There is no second phase.
const PASSED_IS_VISIBLE: bool = true;
const BIAS: f32 = 1.0 / 65536.0;

// Reversed: 1 is the near plane.
fn nearest_depth(centre: vec3<f32>, radius: f32) -> f32 {
    let distance = length(centre);
    if distance <= radius {
        return 1.0;
    }
    let clip = view.clip_from_relative * vec4<f32>(centre * (1.0 - radius / distance), 1.0);
    if clip.w <= 0.0 {
        return 1.0;
    }
    return clamp(clip.z / clip.w, 0.0, 1.0);
}

// Without a filter.
fn sampled(level: u32, uv: vec2<f32>) -> f32 {
    return texel(level, vec2<i32>(floor(uv * level_size(level))));
}

fn is_visible(place: RelativeBox) -> bool {
    let radius = sphere_radius(place);
    let clip = view.clip_from_relative * vec4<f32>(place.centre, 1.0);
    if !(clip.w > 0.0) || !(radius > 0.0) {
        return true;
    }
    let middle = clip.xy / clip.w;
    let scale = abs(vec2<f32>(view.clip_from_view[0].x, view.clip_from_view[1].y) * radius / clip.w);
    let reach = max(scale.x, scale.y);
    if any(abs(middle) - reach > vec2<f32>(1.0)) {
        return true;
    }
    // The diameter in pixels, by the image's height.
    let level = min(level_for(scale.y * view.pixels_high), pyramid.count - 1u);
    let uv = middle * vec2<f32>(0.5, -0.5) + 0.5;
    let low = clamp(uv - reach * 0.5, vec2<f32>(0.0), vec2<f32>(1.0));
    let high = clamp(uv + reach * 0.5, vec2<f32>(0.0), vec2<f32>(1.0));
    let upper = min(sampled(level, low), sampled(level, vec2<f32>(high.x, low.y)));
    let lower = min(sampled(level, vec2<f32>(low.x, high.y)), sampled(level, high));
    return !(nearest_depth(place.centre, radius) < min(upper, lower) - BIAS);
}
