//!import position
// Visible samples by comparing depths in the shader: slower than a forced early depth test, and available everywhere.

struct Varying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) slot: u32,
}

@group(1) @binding(0) var<storage, read_write> counts: array<atomic<u32>>;
// A plain float texture, not a depth one: GL cannot load from depth textures.
@group(1) @binding(1) var occluder_depth: texture_2d<f32>;

@vertex
fn vertex(@location(0) local: vec3<f32>, @location(1) slot: u32) -> Varying {
    var out: Varying;
    out.clip = clip_position(relative_position(instances[slot], local));
    out.slot = slot;
    return out;
}

@fragment
fn fragment(in: Varying) {
    // Reversed depth: at or in front of the occluder means greater or equal.
    if in.clip.z >= textureLoad(occluder_depth, vec2<i32>(in.clip.xy), 0).x {
        atomicAdd(&counts[in.slot], 1u);
    }
}
