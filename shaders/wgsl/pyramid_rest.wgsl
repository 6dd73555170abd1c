//!import pyramid
// The last levels of a depth pyramid, from level 6 on, by one workgroup: each is made from the one before it.

@group(0) @binding(5) var<storage, read> pyramid: Pyramid;
@group(0) @binding(6) var<storage, read_write> texels: array<f32>;

@compute @workgroup_size(64)
fn rest(@builtin(local_invocation_index) lane: u32) {
    for (var level = 6u; level < pyramid.count; level++) {
        let below = pyramid.levels[level - 1u];
        let into = pyramid.levels[level];
        for (var number = lane; number < into.y * into.z; number += 64u) {
            let at = vec2<u32>(number % into.y, number / into.y) * 2u;
            let end = min(at + 1u, below.yz - 1u);
            let one = min(texels[below.x + at.y * below.y + at.x], texels[below.x + at.y * below.y + end.x]);
            let other = min(texels[below.x + end.y * below.y + at.x], texels[below.x + end.y * below.y + end.x]);
            texels[into.x + number] = min(one, other);
        }
        storageBarrier();
    }
}
