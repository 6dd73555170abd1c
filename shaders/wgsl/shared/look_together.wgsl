//!import box_test
// Looks closely at what is open, with the threads of a workgroup that come first: close looks are long, and those that have nothing to look at would wait for them.

var<workgroup> open_lanes: array<u32, 64>;
var<workgroup> open_count: atomic<u32>;
var<workgroup> found_by_lane: array<u32, 64>;

// For all threads of a workgroup of 64 at once, whose instances follow one another. `found` is what a thread's own look has found.
fn look_together(found: u32, index: u32, lane: u32) -> u32 {
    if found == LOOK_OPEN {
        open_lanes[atomicAdd(&open_count, 1u)] = lane;
    }
    workgroupBarrier();
    if lane < atomicLoad(&open_count) {
        let other = open_lanes[lane];
        found_by_lane[other] = look_closely(relative_box(instances[index - lane + other]));
    }
    workgroupBarrier();
    return select(found, found_by_lane[lane], found == LOOK_OPEN);
}
