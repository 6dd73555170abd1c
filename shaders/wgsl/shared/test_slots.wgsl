//!import slot_state_of
// Tests the boxes of slots: what is known of each in the next frame, what is visible and was not drawn first, and what is drawn in all. What was drawn first is not tested where a second phase
// follows: it is tested when the depth is complete.

// Not 0 for what was drawn before the test. It is read and not found again.
@group(0) @binding(2) var<storage, read> first: array<u32>;
@group(0) @binding(3) var<storage, read_write> states: array<u32>;
@group(0) @binding(4) var<storage, read_write> rest: array<u32>;
@group(0) @binding(8) var<storage, read_write> drawn: array<u32>;

@compute @workgroup_size(64)
fn test_slots(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    // More workgroups than a dimension of a dispatch may have come in rows.
    let slot = (group.y * groups.x + group.x) * 64u + lane;
    let is_slot = slot < view.count;
    var is_drawn = false;
    if is_slot {
        is_drawn = first[slot] != 0u;
    }
    let is_last_phase = (view.flags & FRAME_LATE) != 0u;
    let is_tested = is_slot && (is_last_phase || !is_drawn);
    let state = state_of(slot, lane, is_tested);
    if is_slot {
        states[slot] = select(state, SLOT_VISIBLE, is_drawn && !is_last_phase);
        rest[slot] = select(0u, 1u, state == SLOT_VISIBLE && !is_drawn);
        drawn[slot] = select(0u, 1u, state == SLOT_VISIBLE || is_drawn);
    }
}
