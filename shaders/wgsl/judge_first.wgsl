//!import judged
// What is drawn before this frame's test: whatever is in the view and was visible, is new, or is never tested. One bit an instance.

@group(0) @binding(2) var<storage, read> states: array<u32>;
@group(0) @binding(3) var<storage, read_write> first: array<u32>;

// Whether an instance is drawn before this frame's test. What hides nothing can wait for the test.
fn drawn_first(instance: JudgedInstance, known: u32) -> bool {
    if (view.flags & FRAME_LATE) != 0u {
        return known >= VISIBLE;
    }
    return known >= VISIBLE && (instance.traits & HIDES) != 0u;
}

var<workgroup> bits: array<atomic<u32>, 2>;

@compute @workgroup_size(64)
fn choose(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let number = group.y * groups.x + group.x;
    let index = number * 64u + lane;
    if index < view.count {
        let instance = instances[index];
        let known = knowledge(instance, place_of(relative_box(instance)), states[index]);
        if drawn_first(instance, known) {
            atomicOr(&bits[lane / 32u], 1u << (lane % 32u));
        }
    }
    workgroupBarrier();
    let word = number * 2u + lane;
    if lane < 2u && word < arrayLength(&first) {
        first[word] = atomicLoad(&bits[lane]);
    }
}
