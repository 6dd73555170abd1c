//!import look_together
// Judges instances: what is found visible that was not drawn first, and what is hidden, a bit an instance. (Two phases: Haar and Aaltonen,
// GPU-Driven Rendering Pipelines, 2015.)

@group(0) @binding(2) var<storage, read_write> states: array<u32>;
@group(0) @binding(3) var<storage, read_write> rest: array<u32>;
@group(0) @binding(4) var<storage, read_write> hidden: array<u32>;
// What was drawn before the test. It is read and not found again: instances may have changed since.
@group(0) @binding(8) var<storage, read> first: array<u32>;

var<workgroup> rest_bits: array<atomic<u32>, 2>;
var<workgroup> hidden_bits: array<atomic<u32>, 2>;

@compute @workgroup_size(64)
fn test(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let number = group.y * groups.x + group.x;
    let index = number * 64u + lane;
    let bit = 1u << (lane % 32u);
    let is_instance = index < view.count;
    var found = ABSENT;
    var seen = LOOK_SHOWS;
    var is_tested = false;
    if is_instance {
        let instance = instances[index];
        let place = relative_box(instance);
        found = knowledge(instance, place_of(place), states[index]);
        is_tested = found == HIDDEN || found == VISIBLE || found == NEW;
        if is_tested {
            seen = look(place);
        }
    }
    seen = look_together(seen, index, lane);
    if is_tested {
        found = select(VISIBLE, HIDDEN, seen == LOOK_HIDDEN);
    }
    if is_instance {
        states[index] = found | (instances[index].traits & ~255u);
        let more_to_come = (view.flags & FRAME_LATE) == 0u;
        let is_drawn = (first[index / 32u] & bit) != 0u;
        if more_to_come && found >= VISIBLE && !is_drawn {
            atomicOr(&rest_bits[lane / 32u], bit);
        }
        if found == HIDDEN {
            atomicOr(&hidden_bits[lane / 32u], bit);
        }
    }
    workgroupBarrier();
    let word = number * 2u + lane;
    if lane < 2u && word < arrayLength(&rest) {
        rest[word] = atomicLoad(&rest_bits[lane]);
        hidden[word] = atomicLoad(&hidden_bits[lane]);
    }
}
