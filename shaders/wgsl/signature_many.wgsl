//!import transparent_sums
// The oracle's record of transparent entities with several samples a pixel, by comparing depths in the shader. Reading the sample's number makes the
// shader run once for each covered sample.

@group(3) @binding(2) var opaque_depth: texture_multisampled_2d<f32>;

@fragment
fn fragment_of_samples(in: Varying, @builtin(sample_index) number: u32) {
    note(in, in.clip.z >= textureLoad(opaque_depth, vec2<i32>(in.clip.xy), number).x);
}
