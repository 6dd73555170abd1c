// Draws meshes against a finished depth, and counts the pixels that any of them would have changed. Follows `place.wgsl`.

// The number of pixels, and one u32 a pixel: whether it was counted.
@group(0) @binding(2) var<storage, read_write> counted: array<atomic<u32>>;
@group(0) @binding(3) var depth: DEPTH_TEXTURE;

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
