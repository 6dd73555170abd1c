//!import pyramid
// The other levels of a rival's pyramid: two by two texels of the level before, those beyond its edge replaced by those at the edge. Where a side was odd and was rounded down, its last column or row
// is read by no texel; where it was rounded up, by one. All of them do so: they differ in how they round.

@group(0) @binding(5) var<storage, read> pyramid: Pyramid;
@group(0) @binding(6) var<storage, read_write> texels: array<f32>;
// The first level to make, and the one after the last.
@group(0) @binding(0) var<storage, read> range: array<u32, 2>;

fn reduced(level: u32, number: u32) -> f32 {
    let below = pyramid.levels[level - 1u];
    let wide = pyramid.levels[level].y;
    let at = min(vec2<u32>(number % wide, number / wide) * 2u, below.yz - 1u);
    let end = min(at + 1u, below.yz - 1u);
    let upper = min(texels[below.x + at.y * below.y + at.x], texels[below.x + at.y * below.y + end.x]);
    let lower = min(texels[below.x + end.y * below.y + at.x], texels[below.x + end.y * below.y + end.x]);
    return min(upper, lower);
}

// One level.
@compute @workgroup_size(64)
fn level(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let into = pyramid.levels[range[0]];
    let number = id.y * groups.x * 64u + id.x;
    if number < into.y * into.z {
        texels[into.x + number] = reduced(range[0], number);
    }
}

// Several small levels, by one workgroup.
@compute @workgroup_size(64)
fn levels(@builtin(local_invocation_index) lane: u32) {
    for (var at = range[0]; at < range[1]; at++) {
        let into = pyramid.levels[at];
        for (var number = lane; number < into.y * into.z; number += 64u) {
            texels[into.x + number] = reduced(at, number);
        }
        storageBarrier();
    }
}
