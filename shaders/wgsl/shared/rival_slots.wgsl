//!import rival
// Applies a rival's `is_visible` to all slots. A job has two entry points: `first`, before anything is drawn, and `rest`, after that. Words a slot, 1 or 0.

// What the first phase drew unless it is transparent.
@group(0) @binding(2) var<storage, read> seen: array<u32>;
@group(0) @binding(3) var<storage, read_write> found: array<u32>;
@group(0) @binding(4) var<storage, read_write> rest_found: array<u32>;
@group(0) @binding(8) var<storage, read_write> drawn: array<u32>;

fn shows_in_slot(instance: JudgedInstance) -> bool {
    if (instance.traits & LIVE) == 0u {
        return false;
    }
    // Lines, points and what is not tested are drawn, as with every strategy.
    return (instance.traits & TESTED) == 0u || is_visible(relative_box(instance));
}

@compute @workgroup_size(64)
fn first(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let slot = at.y * groups.x * 64u + at.x;
    if slot < min(view.count, arrayLength(&found)) {
        found[slot] = select(0u, 1u, shows_in_slot(instances[slot]));
    }
}

@compute @workgroup_size(64)
fn rest(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let slot = at.y * groups.x * 64u + at.x;
    if slot >= min(view.count, arrayLength(&found)) {
        return;
    }
    let instance = instances[slot];
    let passed = seen[slot] != 0u;
    let visible = (PASSED_IS_VISIBLE && passed) || shows_in_slot(instance);
    let is_drawn = passed && (instance.traits & HIDES) != 0u;
    found[slot] = select(0u, 1u, visible);
    rest_found[slot] = select(0u, 1u, visible && !is_drawn);
    drawn[slot] = select(0u, 1u, visible || is_drawn);
}
