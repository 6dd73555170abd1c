// The view's uniform. World positions are f64 on the host. The eye is the sum of two f32 (high + low).
struct View {
    // Rotation and projection: from world space relative to the camera to clip space, with reversed depth.
    clip_from_relative: mat4x4<f32>,
    eye_high: vec3<f32>,
    pixels_wide: f32,
    eye_low: vec3<f32>,
    pixels_high: f32,
}

@group(0) @binding(0) var<uniform> view: View;
