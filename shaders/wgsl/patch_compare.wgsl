//!import patch
// Marks the pixels of a patch in which a mesh is visible, by comparing depths in the shader: for devices without a forced early depth test.

// A plain float texture, not a depth texture: GL cannot load from depth textures.
@group(3) @binding(1) var finished_depth: texture_2d<f32>;

fn in_front(clip: vec4<f32>) -> bool {
    // Reversed depth: greater is in front of what was drawn. Of what lies in the same place one is drawn over the other, and neither is wrong.
    return clip.z > textureLoad(finished_depth, vec2<i32>(clip.xy), 0).x;
}

@fragment
fn fragment(in: Varying) {
    if in_front(in.clip) {
        mark(in.patch_number, in.clip);
    }
}

@fragment
fn textured_fragment(in: TexturedVarying) {
    if is_there(in) && in_front(in.clip) {
        mark(in.patch_number, in.clip);
    }
}
