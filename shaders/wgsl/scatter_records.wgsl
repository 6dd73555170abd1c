//!import judged_instance
// Writes the records of instances that have moved to their places: one upload, and no copy an instance.

@group(0) @binding(0) var<storage, read> places: array<u32>;
@group(0) @binding(1) var<storage, read> moved: array<JudgedInstance>;
@group(0) @binding(2) var<storage, read_write> records: array<JudgedInstance>;

@compute @workgroup_size(64)
fn scatter_records(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let at = (group.y * groups.x + group.x) * 64u + lane;
    // The first word is the number of records.
    if at < places[0] {
        records[places[at + 1u]] = moved[at];
    }
}
