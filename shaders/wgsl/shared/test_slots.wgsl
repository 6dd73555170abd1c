//!import box_test
// Tests the boxes of all slots, whatever was drawn so far: what is visible by its box, what of it was not drawn first, and what is drawn in all. A word a slot,
// 1 or 0.

// Not 0 where a slot was visible in the last frame. What hides others was then drawn first; what hides nothing waits for the test.
@group(0) @binding(2) var<storage, read> seen: array<u32>;
@group(0) @binding(3) var<storage, read_write> found: array<u32>;
@group(0) @binding(4) var<storage, read_write> rest: array<u32>;
@group(0) @binding(8) var<storage, read_write> drawn: array<u32>;

fn is_visible(instance: JudgedInstance) -> bool {
    if (instance.traits & LIVE) == 0u {
        return false;
    }
    let box = relative_box(instance);
    let at = place_of(box);
    if at == WITHIN && (instance.traits & TESTED) != 0u {
        return shows(box);
    }
    return at != BEYOND;
}

@compute @workgroup_size(64)
fn test_slots(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    // More workgroups than a dimension of a dispatch may have come in rows.
    let slot = at.y * groups.x * 64u + at.x;
    if slot >= view.count {
        return;
    }
    let instance = instances[slot];
    let visible = is_visible(instance);
    let is_drawn = seen[slot] != 0u && (instance.traits & HIDES) != 0u;
    found[slot] = select(0u, 1u, visible);
    rest[slot] = select(0u, 1u, visible && !is_drawn);
    drawn[slot] = select(0u, 1u, visible || is_drawn);
}
