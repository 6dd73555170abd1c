//!import slot_state_of
// Tests the boxes of all slots against an earlier frame's pyramid, from that frame's view. The depth itself is gone, so that the finest level of the pyramid decides.

@group(0) @binding(2) var<storage, read_write> states: array<u32>;

fn nearness(pixel: vec2<u32>) -> f32 {
    let row = pyramid.levels[2];
    let at = pixel >> vec2<u32>(2u);
    return texels[row.x + at.y * row.y + at.x];
}

@compute @workgroup_size(64)
fn recall_slots(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    // More workgroups than a dimension of a dispatch may have come in rows.
    let slot = (group.y * groups.x + group.x) * 64u + lane;
    let is_slot = slot < view.count;
    let state = state_of(slot, lane, is_slot);
    if is_slot {
        states[slot] = state;
    }
}
