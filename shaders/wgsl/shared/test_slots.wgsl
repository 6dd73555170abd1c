//!import slot_state_of
// Tests the boxes of all slots, whatever was drawn so far: what is known of each in the next frame, what is visible and was not drawn first, and what is drawn in all.

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
    let state = state_of(slot, lane, is_slot);
    if is_slot {
        let is_drawn = first[slot] != 0u;
        states[slot] = state;
        rest[slot] = select(0u, 1u, state == SLOT_VISIBLE && !is_drawn);
        drawn[slot] = select(0u, 1u, state == SLOT_VISIBLE || is_drawn);
    }
}
