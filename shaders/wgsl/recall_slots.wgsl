//!import slot_state_of
// Tests the boxes of all slots against an earlier frame's pyramid, from that frame's view. The depth itself is gone, so that the finest level of the pyramid decides.

@group(0) @binding(2) var<storage, read_write> states: array<u32>;

fn nearness(pixel: vec2<u32>) -> f32 {
    let row = pyramid.levels[2];
    let at = pixel >> vec2<u32>(2u);
    return texels[row.x + at.y * row.y + at.x];
}

@compute @workgroup_size(64)
fn recall_slots(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    // More workgroups than a dimension of a dispatch may have come in rows.
    let slot = at.y * groups.x * 64u + at.x;
    if slot < view.count {
        states[slot] = state_of(instances[slot]);
    }
}
