//!import position
// Depth alone: the occluder depth pass, and the geometry of hardware occlusion queries.

@vertex
fn vertex(@location(0) local: vec3<f32>, @location(1) slot: u32) -> @invariant @builtin(position) vec4<f32> {
    return clip_position(relative_position(instances[slot], local));
}
