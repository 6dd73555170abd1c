// Two counts of visible samples a slot made one: the larger. What was drawn is what either of them had drawn.

@group(0) @binding(0) var<storage, read> one: array<u32>;
@group(0) @binding(1) var<storage, read> other: array<u32>;
@group(0) @binding(2) var<storage, read_write> joined: array<u32>;

@compute @workgroup_size(64)
fn join(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let slot = at.y * groups.x * 64u + at.x;
    if slot < min(arrayLength(&joined), min(arrayLength(&one), arrayLength(&other))) {
        joined[slot] = max(one[slot], other[slot]);
    }
}
