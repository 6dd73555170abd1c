// Where the vertices of placed meshes are in the image. Other shaders follow this one.

struct Frame {
    clip_from_world: mat4x4<f32>,
    width: u32,
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> places: array<mat4x4<f32>>;

@vertex
fn place(@location(0) position: vec3<f32>, @builtin(instance_index) number: u32) -> @builtin(position) vec4<f32> {
    // In the two steps of Bevy's own shaders.
    let world = places[number] * vec4<f32>(position, 1.0);
    return frame.clip_from_world * vec4<f32>(world.xyz, 1.0);
}

