// Draws meshes against a finished depth, and counts the pixels that any of them would have changed.

struct Frame {
    clip_from_world: mat4x4<f32>,
    width: u32,
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> places: array<mat4x4<f32>>;
// The number of pixels, and one u32 a pixel: whether it was counted.
@group(0) @binding(2) var<storage, read_write> counted: array<atomic<u32>>;
@group(0) @binding(3) var depth: DEPTH_TEXTURE;

@vertex
fn place(@location(0) position: vec3<f32>, @builtin(instance_index) number: u32) -> @builtin(position) vec4<f32> {
    // In the two steps of Bevy's own shaders.
    let world = places[number] * vec4<f32>(position, 1.0);
    return frame.clip_from_world * vec4<f32>(world.xyz, 1.0);
}

fn count(at: vec4<f32>, sample: u32) {
    let pixel = vec2<u32>(at.xy);
    // Reversed: greater is nearer.
    if at.z > textureLoad(depth, vec2<i32>(pixel), i32(sample)) {
        let before = atomicExchange(&counted[1u + pixel.y * frame.width + pixel.x], 1u);
        if before == 0u {
            atomicAdd(&counted[0], 1u);
        }
    }
}

@fragment
fn count_pixels(@builtin(position) at: vec4<f32>) {
    count(at, 0u);
}

@fragment
fn count_samples(@builtin(position) at: vec4<f32>, @builtin(sample_index) sample: u32) {
    count(at, sample);
}
