//!import pyramid
// The first levels of a depth pyramid: a workgroup takes 32 x 32 pixels, a thread 4 x 4 of them. `nearness` is that of the depth at hand.

@group(0) @binding(5) var<storage, read> pyramid: Pyramid;
@group(0) @binding(6) var<storage, read_write> texels: array<f32>;

var<workgroup> least: array<f32, 64>;

fn store(level: u32, at: vec2<u32>, value: f32) {
    let place = pyramid.levels[level];
    if level < pyramid.count && all(at < place.yz) {
        texels[place.x + at.y * place.y + at.x] = value;
    }
}

@compute @workgroup_size(8, 8)
fn reduce(@builtin(workgroup_id) tile: vec3<u32>, @builtin(local_invocation_id) lane: vec3<u32>) {
    // A pixel beyond the edge is the one at the edge instead. Wherever a texel stands for any pixel of the image, that one is among them.
    let last = vec2<u32>(pyramid.width, pyramid.height) - 1u;
    let block = tile.xy * 8u + lane.xy;
    var farthest = NEAREST;
    for (var y = 0u; y < 4u; y++) {
        for (var x = 0u; x < 4u; x++) {
            farthest = min(farthest, nearness(min(block * 4u + vec2<u32>(x, y), last)));
        }
    }
    store(2u, block, farthest);
    let own = lane.y * 8u + lane.x;
    least[own] = farthest;
    // Levels 3 to 5: each halves the side of the threads that go on.
    for (var step = 1u; step < 8u; step *= 2u) {
        workgroupBarrier();
        if all(lane.xy % vec2<u32>(step * 2u) == vec2<u32>(0u)) {
            let pairs = min(min(least[own], least[own + step]), min(least[own + step * 8u], least[own + step * 9u]));
            least[own] = pairs;
            store(3u + firstTrailingBit(step), block / vec2<u32>(step * 2u), pairs);
        }
    }
}
