//!import position
//!import material
// The record of a visible transparent fragment: it adds a hash of its entity's id to its pixel's signature, and one to its slot's samples. Unlike
// blended colours, sums do not depend on the drawing order.

struct Varying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) slot: u32,
    @location(1) uv: vec2<f32>,
    @location(2) colour: vec4<f32>,
}

@group(3) @binding(0) var<storage, read_write> signatures: array<atomic<u32>>;
@group(3) @binding(1) var<storage, read_write> samples: array<atomic<u32>>;

@vertex
fn vertex(
    @location(0) local: vec3<f32>,
    @location(1) slot: u32,
    @location(2) normal: vec4<f32>,
    @location(3) uv: vec2<f32>,
    @location(4) colour: vec4<f32>,
) -> Varying {
    var out: Varying;
    out.clip = clip_position(relative_position(instances[slot], local));
    out.slot = slot;
    out.uv = image_place(instances[slot].material, uv);
    out.colour = colour;
    return out;
}

// The finaliser of MurmurHash3 (Appleby), so that neighbouring ids have unrelated hashes.
fn hashed(id: u32) -> u32 {
    var h = id;
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return h ^ (h >> 16u);
}

// Takes a fragment down if it is visible. Less than half of an 8-bit step of opacity does not change the image. It samples, so hidden fragments must call it too: their neighbours need them.
fn note(in: Varying, visible: bool) {
    let base = base_colour(materials[instances[in.slot].material], in.uv, in.colour);
    if visible && base.a >= 0.002 {
        let pixel = vec2<u32>(in.clip.xy);
        atomicAdd(&signatures[pixel.y * u32(view.pixels_wide) + pixel.x], hashed(in.slot + 1u));
        atomicAdd(&samples[in.slot], 1u);
    }
}
