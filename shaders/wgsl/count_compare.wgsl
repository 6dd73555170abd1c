//!import counted
// Counts visible samples by comparing depths in the shader: slower than a forced early depth test, but available on every device.

// A plain float texture, not a depth texture: GL cannot load from depth textures.
@group(1) @binding(1) var occluder_depth: texture_2d<f32>;

@fragment
fn fragment(in: Varying) {
    // Reversed depth: greater or equal is at or in front of the occluder.
    if in.clip.z >= textureLoad(occluder_depth, vec2<i32>(in.clip.xy), 0).x {
        atomicAdd(&counts[in.slot], 1u);
    }
}
