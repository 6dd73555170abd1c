//!import position
// Depth only: for the occluder depth pass and for hardware occlusion queries.

@vertex
fn vertex(@location(0) local: vec3<f32>, @location(1) slot: u32) -> @invariant @builtin(position) vec4<f32> {
    return clip_position(relative_position(instances[slot], local));
}
