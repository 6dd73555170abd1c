//!import position
// Counts visible samples by comparing depths in the shader: slower than a forced early depth test, but available on every device.

struct Varying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) slot: u32,
}

// Visible samples by slot.
@group(1) @binding(0) var<storage, read_write> counts: array<atomic<u32>>;
// A plain float texture, not a depth texture: GL cannot load from depth textures.
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
    // Reversed depth: greater or equal is at or in front of the occluder.
    if in.clip.z >= textureLoad(occluder_depth, vec2<i32>(in.clip.xy), 0).x {
        atomicAdd(&counts[in.slot], 1u);
    }
}
