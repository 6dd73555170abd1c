//!import packed_id
// A histogram of entity ids; each layer of workgroups takes one sample of all pixels. A run of equal ids in a row is added with one atomic operation, since atomics dominate the cost and neighbouring
// pixels mostly belong to the same entity.

@group(0) @binding(1) var<storage, read_write> counts: array<atomic<u32>>;

// Pixels that one thread reads.
const RUN: u32 = 16u;

@compute @workgroup_size(64)
fn count(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let size = textureDimensions(ids);
    let runs_a_row = (size.x + RUN - 1u) / RUN;
    // A large image has more workgroups than a dimension of a dispatch may have: they come in rows.
    let number = at.y * groups.x * 64u + at.x;
    let y = number / runs_a_row;
    if y >= size.y {
        return;
    }
    let first = (number % runs_a_row) * RUN;
    let last = min(first + RUN, size.x);
    var current = 0u;
    var length = 0u;
    for (var x = first; x < last; x++) {
        let id = unpacked_id(texel(vec2<u32>(x, y), at.z));
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
