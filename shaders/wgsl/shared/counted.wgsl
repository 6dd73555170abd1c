//!import position
// What is counted: the vertex stage of the passes in which fragments count themselves, and the counts.

struct Varying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) slot: u32,
}

// Visible samples by slot.
@group(1) @binding(0) var<storage, read_write> counts: array<atomic<u32>>;

@vertex
fn vertex(@location(0) local: vec3<f32>, @location(1) slot: u32) -> Varying {
    var out: Varying;
    out.clip = clip_position(relative_position(instances[slot], local));
    out.slot = slot;
    return out;
}
