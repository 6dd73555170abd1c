//!import clip
//!import eye_relative
//!import instance
// The position of an instance's vertices. All passes that share a depth buffer must use this function and `clip_position`: different
// expressions for the same point can differ in the last bit, and then equal depths do not compare as equal.

// From a mesh's own space to world space relative to the eye.
fn relative_position(instance: Instance, local: vec3<f32>) -> vec3<f32> {
    let linear = vec3<f32>(
        dot(instance.row_x.xyz, local),
        dot(instance.row_y.xyz, local),
        dot(instance.row_z.xyz, local),
    );
    let high = vec3<f32>(instance.row_x.w, instance.row_y.w, instance.row_z.w);
    return linear + eye_relative(high, instance.origin_low);
}
