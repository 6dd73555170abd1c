//!import frame
// A test job with one of each kind of resource, so that reflection has something to say about all of them.
enable f16;

struct Particle {
    position: vec3<f32>,
    age: f32,
    spins: array<vec3<f32>, 2>,
}

struct Cloud {
    count: atomic<u32>,
    particles: array<Particle>,
}

struct Input {
    @location(0) position: vec3<f32>,
    @location(2) weights: vec4<u32>,
    @location(1) uv: vec2<f32>,
    @builtin(vertex_index) index: u32,
}

struct Moved {
    shift: vec2<f32>,
}

override wide: u32 = 64;
@id(7) override gain: f32;

@group(1) @binding(0) var<storage, read> read_cloud: array<Particle>;
@group(1) @binding(1) var<storage, read_write> cloud: Cloud;
@group(1) @binding(2) var picture: texture_2d<f32>;
@group(1) @binding(3) var picture_sampler: sampler;
@group(1) @binding(4) var shadow: texture_depth_2d_array;
@group(1) @binding(5) var shadow_sampler: sampler_comparison;
@group(1) @binding(6) var loaded: texture_multisampled_2d<f32>;
@group(1) @binding(7) var target_image: texture_storage_2d<rgba16float, write>;
@group(1) @binding(8) var ids: texture_2d<u32>;
@group(1) @binding(9) var both: texture_2d<f32>;
@group(1) @binding(10) var<uniform> unused: Moved;
var<immediate> moved: Moved;

fn sampled(image: texture_2d<f32>, by: sampler, at: vec2<f32>) -> vec4<f32> {
    return textureSampleLevel(image, by, at, 0.0);
}

@vertex
fn vertex(in: Input, @location(5) extra: i32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(in.position + read_cloud[in.index].position, f32(extra)) + vec4<f32>(in.uv, moved.shift)
        + vec4<f32>(in.weights) + textureLoad(both, vec2<i32>(0), 0);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let lit = textureSampleCompareLevel(shadow, shadow_sampler, at.xy, 0, at.z);
    let half = f16(lit);
    return sampled(picture, picture_sampler, at.xy) * f32(half) * gain * frame.time
        + sampled(both, picture_sampler, at.xy)
        + textureLoad(loaded, vec2<i32>(at.xy), 0) + vec4<f32>(textureLoad(ids, vec2<i32>(at.xy), 0));
}

@compute @workgroup_size(wide, 2)
fn compute(@builtin(global_invocation_id) at: vec3<u32>) {
    let slot = atomicAdd(&cloud.count, 1u);
    cloud.particles[slot].age = read_cloud[at.x].age;
    textureStore(target_image, at.xy, vec4<f32>(frame.time));
}
