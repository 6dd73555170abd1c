// Visible samples from an entity-id buffer: a histogram of ids. Runs of equal ids along a row are added in one go,
// since neighbouring pixels mostly belong to the same entity and atomics are what costs.

@group(0) @binding(0) var ids: texture_2d<u32>;
@group(0) @binding(1) var<storage, read_write> counts: array<atomic<u32>>;

const RUN: u32 = 16u;

@compute @workgroup_size(64)
fn count(@builtin(global_invocation_id) at: vec3<u32>) {
    let size = textureDimensions(ids);
    let runs_a_row = (size.x + RUN - 1u) / RUN;
    let y = at.x / runs_a_row;
    if y >= size.y {
        return;
    }
    let first = (at.x % runs_a_row) * RUN;
    let last = min(first + RUN, size.x);
    var current = 0u;
    var length = 0u;
    for (var x = first; x < last; x++) {
        let id = textureLoad(ids, vec2<u32>(x, y), 0).x;
        if id != current {
            if current != 0u {
                atomicAdd(&counts[current - 1u], length);
            }
            current = id;
            length = 0u;
        }
        length++;
    }
    if current != 0u {
        atomicAdd(&counts[current - 1u], length);
    }
}
