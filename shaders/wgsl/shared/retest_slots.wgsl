//!import slot_state_of
// Tests the boxes of what was drawn once more, now that the depth is complete: what is known of it in the next frame. What the first test has found hidden stays so.

// Not 0 for what was drawn.
@group(0) @binding(2) var<storage, read> drawn: array<u32>;
@group(0) @binding(3) var<storage, read_write> states: array<u32>;

@compute @workgroup_size(64)
fn retest_slots(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    // More workgroups than a dimension of a dispatch may have come in rows.
    let slot = (group.y * groups.x + group.x) * 64u + lane;
    var is_drawn = false;
    if slot < view.count {
        is_drawn = drawn[slot] != 0u;
    }
    let state = state_of(slot, lane, is_drawn);
    if is_drawn {
        states[slot] = state;
    }
}
