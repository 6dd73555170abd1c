//!import clip
//!import instance
// Where an instance's vertices are. Every pass that shares a depth buffer must go through this and `clip_position`, to the letter:
// different expressions for the same point differ in the last bit, and then equal depths are not equal.

// From a mesh's own space to world space relative to the eye.
fn relative_position(instance: Instance, local: vec3<f32>) -> vec3<f32> {
    let turned = vec3<f32>(
        dot(instance.row_x.xyz, local),
        dot(instance.row_y.xyz, local),
        dot(instance.row_z.xyz, local),
    );
    let high = vec3<f32>(instance.row_x.w, instance.row_y.w, instance.row_z.w) - view.eye_high;
    let low = instance.origin_low - view.eye_low;
    return turned + (high + low);
}
