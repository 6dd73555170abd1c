//!import clip
// The shaders of `gpu_strategy.rs`: levels of a depth pyramid, and the test of boxes against it. Depth is reversed: the least depth is the farthest.

// The depth, where a pixel has one sample. Not a `texture_depth_2d`: OpenGL cannot load from one.
@group(0) @binding(1) var depth: texture_2d<f32>;
// The depth, where a pixel has several.
@group(0) @binding(2) var samples: texture_multisampled_2d<f32>;
// A level, and the next.
@group(0) @binding(3) var finer: texture_storage_2d<r32float, read>;
@group(0) @binding(4) var coarser: texture_storage_2d<r32float, write>;

// Nearer than any depth.
const NEAREST: f32 = 2.0;

struct Block {
    first: vec2<u32>,
    last: vec2<u32>,
}

// What a texel stands for: two texels a side of the finer level. The last texel of an odd side stands for three, or one would be missing.
fn block_of(at: vec2<u32>, fine: vec2<u32>, coarse: vec2<u32>) -> Block {
    return Block(at * 2u, select(at * 2u + 1u, fine - 1u, at + 1u == coarse));
}

@compute @workgroup_size(8, 8)
fn reduce_depth(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(coarser);
    if any(id.xy >= size) {
        return;
    }
    let block = block_of(id.xy, textureDimensions(depth), size);
    var farthest = NEAREST;
    for (var y = block.first.y; y <= block.last.y; y++) {
        for (var x = block.first.x; x <= block.last.x; x++) {
            farthest = min(farthest, textureLoad(depth, vec2<u32>(x, y), 0).x);
        }
    }
    textureStore(coarser, id.xy, vec4<f32>(farthest));
}

@compute @workgroup_size(8, 8)
fn reduce_samples(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(coarser);
    if any(id.xy >= size) {
        return;
    }
    let block = block_of(id.xy, textureDimensions(samples), size);
    var farthest = NEAREST;
    for (var y = block.first.y; y <= block.last.y; y++) {
        for (var x = block.first.x; x <= block.last.x; x++) {
            for (var number = 0u; number < textureNumSamples(samples); number++) {
                farthest = min(farthest, textureLoad(samples, vec2<u32>(x, y), number).x);
            }
        }
    }
    textureStore(coarser, id.xy, vec4<f32>(farthest));
}

@compute @workgroup_size(8, 8)
fn reduce(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(coarser);
    if any(id.xy >= size) {
        return;
    }
    let block = block_of(id.xy, textureDimensions(finer), size);
    var farthest = NEAREST;
    for (var y = block.first.y; y <= block.last.y; y++) {
        for (var x = block.first.x; x <= block.last.x; x++) {
            farthest = min(farthest, textureLoad(finer, vec2<u32>(x, y)).x);
        }
    }
    textureStore(coarser, id.xy, vec4<f32>(farthest));
}

// The number of tests, then the slot of each.
@group(0) @binding(5) var<storage, read> tested: array<u32>;
// Centre and half edges, relative to the eye.
@group(0) @binding(6) var<storage, read> boxes: array<array<f32, 12>>;
// Level 0 has a texel for 2 x 2 pixels.
@group(0) @binding(7) var pyramid: texture_2d<f32>;
@group(0) @binding(8) var<storage, read> before: array<u32>;
@group(0) @binding(9) var<storage, read_write> counts: array<u32>;

// A count says more than whether an entity is visible, so that one buffer serves both passes, the verdicts and the next frame. What is not 0 is
// drawn in this frame; what is at least `AGAIN` is visible, and drawn first in the next.
const HIDDEN: u32 = 0u;
// Drawn first, and hidden.
const NO_LONGER: u32 = 1u;
// Drawn first, and visible.
const AGAIN: u32 = 2u;
// Visible, and not drawn yet.
const FOUND: u32 = 3u;

// The error of f32 maths, as a fraction of the terms.
const ROUNDING: f32 = 1e-6;
fn point(index: u32, at: u32) -> vec3<f32> {
    return vec3<f32>(boxes[index][at], boxes[index][at + 1u], boxes[index][at + 2u]);
}

// A corner's place in pixels, and its depth. A corner beside the eye is nearer than anything.
fn projected(index: u32, corner: u32) -> vec3<f32> {
    let far = (vec3<u32>(corner) & vec3<u32>(1u, 2u, 4u)) != vec3<u32>(0u);
    let side = select(vec3<f32>(-1.0), vec3<f32>(1.0), far);
    let relative = point(index, 0u) + side.x * point(index, 3u) + side.y * point(index, 6u) + side.z * point(index, 9u);
    // The function that all vertices go through: other expressions have other bits.
    let clip = clip_position(relative);
    if !(clip.w > 0.0) {
        return vec3<f32>(0.0, 0.0, NEAREST);
    }
    let m = view.clip_from_relative;
    let terms = dot(abs(vec3<f32>(m[0].z, m[1].z, m[2].z)), abs(relative)) + abs(m[3].z);
    let seen = clip.xy / clip.w * vec2<f32>(0.5, -0.5) + 0.5;
    return vec3<f32>(seen * vec2<f32>(view.pixels_wide, view.pixels_high), (clip.z + ROUNDING * terms) / clip.w);
}

var<workgroup> corners: array<vec3<f32>, 8>;
var<workgroup> shows: atomic<u32>;

// A workgroup tests one box: eight of its invocations project a corner each, and all sixteen read a texel each.
@compute @workgroup_size(16)
fn test(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let index = group.y * groups.x + group.x;
    if index >= tested[0] {
        return;
    }
    if lane < 8u {
        corners[lane] = projected(index, lane);
    }
    workgroupBarrier();
    var low = corners[0];
    var high = corners[0];
    for (var corner = 1u; corner < 8u; corner++) {
        low = min(low, corners[corner]);
        high = max(high, corners[corner]);
    }
    // The pixels that the box touches; those that it covers are among them, wherever a pixel's samples lie.
    let end = vec2<f32>(view.pixels_wide, view.pixels_high) - 1.0;
    let first = vec2<u32>(clamp(floor(low.xy), vec2<f32>(0.0), end));
    let last = vec2<u32>(clamp(floor(high.xy), vec2<f32>(0.0), end));
    // The finest level at which these are at most four texels a side. It is the same for the whole workgroup: where invocations ask for the size of
    // different levels, llvmpipe answers all of them with the size of one.
    var level = 0u;
    while any((last >> vec2<u32>(level + 1u)) - (first >> vec2<u32>(level + 1u)) > vec2<u32>(3u)) {
        level++;
    }
    // The last texel of a level stands for all that is left.
    let mip = i32(level); // On OpenGL, textureLoad takes no unsigned level.
    let edge = textureDimensions(pyramid, mip) - 1u;
    let texel = min(first >> vec2<u32>(level + 1u), edge) + vec2<u32>(lane % 4u, lane / 4u);
    let inside = all(texel <= min(last >> vec2<u32>(level + 1u), edge));
    // Equal depths are visible.
    if inside && !(high.z < textureLoad(pyramid, texel, mip).x) {
        atomicStore(&shows, 1u);
    }
    workgroupBarrier();
    if lane == 0u {
        let slot = tested[index + 1u];
        let drawn = before[slot] >= AGAIN;
        counts[slot] = select(select(HIDDEN, NO_LONGER, drawn), select(FOUND, AGAIN, drawn), atomicLoad(&shows) != 0u);
    }
}
