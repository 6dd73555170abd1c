//!import clip
// Boxes for hardware occlusion queries: centres and half axes, relative to the eye. Each box is a triangle strip of fourteen vertices, whose
// front faces are counter-clockwise where the axes are right-handed.

// For each axis, the vertices of the strip at its positive end, one bit a vertex.
const FAR_ENDS: vec3<u32> = vec3<u32>(0x287au, 0x02afu, 0x31e3u);

@vertex
fn vertex(
    @builtin(vertex_index) corner: u32,
    @location(0) centre: vec3<f32>,
    @location(1) x: vec3<f32>,
    @location(2) y: vec3<f32>,
    @location(3) z: vec3<f32>,
) -> @invariant @builtin(position) vec4<f32> {
    let far = (FAR_ENDS & vec3<u32>(1u << corner)) != vec3<u32>(0u);
    let side = select(vec3<f32>(-1.0), vec3<f32>(1.0), far);
    return clip_position(centre + x * side.x + y * side.y + z * side.z);
}
