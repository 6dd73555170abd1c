//!import position
// Visible samples by fragment atomics: a fragment that survives the forced early depth test adds one to its entity.

struct Varying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) slot: u32,
}

@group(1) @binding(0) var<storage, read_write> counts: array<atomic<u32>>;

@vertex
fn vertex(@location(0) local: vec3<f32>, @location(1) slot: u32) -> Varying {
    var out: Varying;
    out.clip = clip_position(relative_position(instances[slot], local));
    out.slot = slot;
    return out;
}

// Without the forced early test hidden fragments would be counted too: a shader that writes memory runs before the test.
@fragment @early_depth_test(force)
fn fragment(in: Varying) {
    atomicAdd(&counts[in.slot], 1u);
}
