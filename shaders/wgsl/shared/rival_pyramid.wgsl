//!import pyramid
// Pyramids of farthest depths as other engines make them, as yardsticks: entry points for the first level, one a rule, by a depth of any number of samples a pixel.

@group(0) @binding(5) var<storage, read> pyramid: Pyramid;
@group(0) @binding(6) var<storage, read_write> texels: array<f32>;

// Stores a texel of level 0.
fn store(at: vec2<u32>, value: f32) {
    let place = pyramid.levels[0];
    texels[place.x + at.y * place.y + at.x] = value;
}

fn is_beyond(at: vec2<u32>) -> bool {
    return any(at >= pyramid.levels[0].yz);
}

// The nearness of a pixel's farthest sample; beyond the image's edge that of the pixel at the edge.
fn clamped(at: vec2<i32>) -> f32 {
    return nearness(vec2<u32>(clamp(at, vec2<i32>(0), vec2<i32>(i32(pyramid.width), i32(pyramid.height)) - 1)));
}

// What a linear, clamped sampler with minimum reduction answers, and the least of what a gather answers. `uv` is a place on the image, 0 to 1.
fn gathered(uv: vec2<f32>) -> f32 {
    let first = vec2<i32>(floor(uv * vec2<f32>(f32(pyramid.width), f32(pyramid.height)) - 0.5));
    let upper = min(clamped(first), clamped(first + vec2<i32>(1, 0)));
    let lower = min(clamped(first + vec2<i32>(0, 1)), clamped(first + vec2<i32>(1, 1)));
    return min(upper, lower);
}

// A block of so many pixels a side.
fn farthest_in_block(at: vec2<u32>, side: u32) -> f32 {
    var farthest = NEAREST;
    for (var y = 0u; y < side; y++) {
        for (var x = 0u; x < side; x++) {
            farthest = min(farthest, clamped(vec2<i32>(at * side + vec2<u32>(x, y))));
        }
    }
    return farthest;
}

// Helio: the depth itself.
@compute @workgroup_size(8, 8)
fn copied(@builtin(global_invocation_id) id: vec3<u32>) {
    if !is_beyond(id.xy) {
        store(id.xy, farthest_in_block(id.xy, 1u));
    }
}

// vk_lod_clusters: two by two pixels.
@compute @workgroup_size(8, 8)
fn halved(@builtin(global_invocation_id) id: vec3<u32>) {
    if !is_beyond(id.xy) {
        store(id.xy, farthest_in_block(id.xy, 2u));
    }
}

// Unity: eight by eight pixels.
@compute @workgroup_size(8, 8)
fn in_eighths(@builtin(global_invocation_id) id: vec3<u32>) {
    if !is_beyond(id.xy) {
        store(id.xy, farthest_in_block(id.xy, 8u));
    }
}

// niagara: one sample at the texel's middle.
@compute @workgroup_size(8, 8)
fn sampled(@builtin(global_invocation_id) id: vec3<u32>) {
    if !is_beyond(id.xy) {
        store(id.xy, gathered((vec2<f32>(id.xy) + 0.5) / vec2<f32>(pyramid.levels[0].yz)));
    }
}

// Bevy: two by two pixels of an image that is enlarged to twice this level, each of them a gather.
@compute @workgroup_size(8, 8)
fn enlarged(@builtin(global_invocation_id) id: vec3<u32>) {
    if is_beyond(id.xy) {
        return;
    }
    let size = vec2<f32>(pyramid.levels[0].yz) * 2.0;
    var farthest = NEAREST;
    for (var corner = 0u; corner < 4u; corner++) {
        let at = id.xy * 2u + vec2<u32>(corner & 1u, corner >> 1u);
        farthest = min(farthest, gathered((vec2<f32>(at) + 0.5) / size));
    }
    store(id.xy, farthest);
}
