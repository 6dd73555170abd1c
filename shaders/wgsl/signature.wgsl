//!import transparent_sums
// The oracle's record of transparent entities, by comparing depths in the shader.

@group(3) @binding(2) var opaque_depth: texture_2d<f32>;

@fragment
fn fragment(in: Varying) {
    note(in, in.clip.z >= textureLoad(opaque_depth, vec2<i32>(in.clip.xy), 0).x);
}
