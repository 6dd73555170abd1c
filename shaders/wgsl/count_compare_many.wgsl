//!import counted
// As `count_compare.wgsl`, for several samples a pixel. Reading the sample's number makes the shader run once for each covered sample, with the
// depth there.

@group(1) @binding(1) var occluder_depth: texture_multisampled_2d<f32>;

@fragment
fn fragment_of_samples(in: Varying, @builtin(sample_index) number: u32) {
    // Reversed depth: greater or equal is at or in front of the occluder.
    if in.clip.z >= textureLoad(occluder_depth, vec2<i32>(in.clip.xy), number).x {
        atomicAdd(&counts[in.slot], 1u);
    }
}
