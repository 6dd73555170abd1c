// Merges two counts of visible samples a slot: the larger of the two. An entity that either count shows is then drawn.

@group(0) @binding(0) var<storage, read> first: array<u32>;
@group(0) @binding(1) var<storage, read> second: array<u32>;
@group(0) @binding(2) var<storage, read_write> merged: array<u32>;

@compute @workgroup_size(64)
fn max_counts(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let slot = at.y * groups.x * 64u + at.x;
    if slot < min(arrayLength(&merged), min(arrayLength(&first), arrayLength(&second))) {
        merged[slot] = max(first[slot], second[slot]);
    }
}
