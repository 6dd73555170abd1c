//!import judged_instance
//!import relative_box
//!import pyramid
// What the occlusion tests of other engines have in common, as yardsticks: a view, a pyramid of farthest depths, and samplers in compute. Depth is reversed, so the farthest
// is the least. Texture coordinates go from 0 to 1, downwards.

struct RivalView {
    clip_from_relative: mat4x4<f32>,
    view_from_relative: mat4x4<f32>,
    clip_from_view: mat4x4<f32>,
    eye_high: vec3<f32>,
    pixels_wide: f32,
    eye_low: vec3<f32>,
    pixels_high: f32,
    // Number of slots.
    count: u32,
    // 1 for a perspective view whose axis is in the image's middle.
    on_axis: u32,
    padding_a: u32,
    padding_b: u32,
}

@group(0) @binding(0) var<storage, read> view: RivalView;
@group(0) @binding(1) var<storage, read> instances: array<JudgedInstance>;
// Of `levels` only the first, the width and the height are used; level 0 is kept here.
@group(0) @binding(5) var<storage, read> pyramid: Pyramid;
@group(0) @binding(6) var<storage, read> texels: array<f32>;

fn level_size(level: u32) -> vec2<f32> {
    return vec2<f32>(pyramid.levels[level].yz);
}

// A texel; what is beyond the edge is the one at the edge.
fn texel(level: u32, at: vec2<i32>) -> f32 {
    let place = pyramid.levels[level];
    let inside = vec2<u32>(clamp(at, vec2<i32>(0), vec2<i32>(place.yz) - 1));
    return texels[place.x + inside.y * place.y + inside.x];
}

// The farthest of two by two texels, the first of them given.
fn farthest_of_four(level: u32, first: vec2<i32>) -> f32 {
    let upper = min(texel(level, first), texel(level, first + vec2<i32>(1, 0)));
    let lower = min(texel(level, first + vec2<i32>(0, 1)), texel(level, first + vec2<i32>(1, 1)));
    return min(upper, lower);
}

// What a linear, clamped sampler with minimum reduction answers.
fn sampled_farthest(level: u32, uv: vec2<f32>) -> f32 {
    return farthest_of_four(level, vec2<i32>(floor(uv * level_size(level) - 0.5)));
}

// The exponent of the least power of two that a side fits into, within the levels there are. What is not a number gives 0.
fn level_for(side: f32) -> u32 {
    return u32(clamp(ceil(log2(max(side, 1.0))), 0.0, 31.0));
}

// Whether a rectangle lies in two by two texels of a level with the first of them at its upper left corner.
fn fits_four(level: u32, low: vec2<f32>, high: vec2<f32>) -> bool {
    let size = level_size(level);
    return all(fract(low * size) + (high - low) * size <= vec2<f32>(2.0));
}

// A box as it is seen, from its eight corners.
struct SeenBox {
    low: vec2<f32>,
    high: vec2<f32>,
    // The greatest depth.
    nearest: f32,
    // The least w, and the least distance from the near plane, times w.
    least_w: f32,
    least_gap: f32,
    // The greatest z in view space, which grows towards the eye and beyond it.
    most_z: f32,
}

fn seen_box(place: RelativeBox) -> SeenBox {
    var seen = SeenBox(vec2<f32>(3e38), vec2<f32>(-3e38), -3e38, 3e38, 3e38, -3e38);
    for (var corner = 0u; corner < 8u; corner++) {
        let side = select(vec3<f32>(-1.0), vec3<f32>(1.0), (vec3<u32>(corner) & vec3<u32>(1u, 2u, 4u)) != vec3<u32>(0u));
        let at = vec4<f32>(place.centre + place.x * side.x + place.y * side.y + place.z * side.z, 1.0);
        let clip = view.clip_from_relative * at;
        let uv = clip.xy / clip.w * vec2<f32>(0.5, -0.5) + 0.5;
        seen.low = min(seen.low, uv);
        seen.high = max(seen.high, uv);
        seen.nearest = max(seen.nearest, clip.z / clip.w);
        seen.least_w = min(seen.least_w, clip.w);
        seen.least_gap = min(seen.least_gap, clip.w - clip.z);
        seen.most_z = max(seen.most_z, (view.view_from_relative * at).z);
    }
    return seen;
}

// A sphere around what is in a box: that of the box, or of the ellipsoid that its contents lie in.
fn sphere_radius(place: RelativeBox) -> f32 {
    let squares = vec3<f32>(dot(place.x, place.x), dot(place.y, place.y), dot(place.z, place.z));
    let of_box = sqrt(squares.x + squares.y + squares.z);
    let of_ellipsoid = place.round * sqrt(max(squares.x, max(squares.y, squares.z)));
    return select(of_box, min(of_box, of_ellipsoid), place.round > 0.0);
}
