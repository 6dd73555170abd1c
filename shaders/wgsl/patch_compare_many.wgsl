//!import patch
// As `patch_compare.wgsl`, for several samples a pixel: a pixel is marked if the mesh is visible in any of its samples.

@group(3) @binding(1) var finished_depth: texture_multisampled_2d<f32>;

fn in_front(clip: vec4<f32>, number: u32) -> bool {
    // Reversed depth: greater is in front of what was drawn. Of what lies in the same place one is drawn over the other, and neither is wrong.
    return clip.z > textureLoad(finished_depth, vec2<i32>(clip.xy), number).x;
}

@fragment
fn fragment_of_samples(in: Varying, @builtin(sample_index) number: u32) {
    if in_front(in.clip, number) {
        mark(in.patch_number, in.clip);
    }
}

@fragment
fn textured_fragment_of_samples(in: TexturedVarying, @builtin(sample_index) number: u32) {
    if is_there(in) && in_front(in.clip, number) {
        mark(in.patch_number, in.clip);
    }
}
