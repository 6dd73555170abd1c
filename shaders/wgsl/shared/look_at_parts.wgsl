//!import box_test
//!import part_box
// Looks at the boxes of the parts of what its own box shows, with all threads of a workgroup: it shows where a part does.

var<workgroup> shown_lanes: array<u32, 64>;
var<workgroup> shown_count: atomic<u32>;
var<workgroup> shows: array<atomic<u32>, 64>;

// The most parts of a mesh.
const MOST_PARTS: u32 = 16u;

// For all threads of a workgroup of 64 at once, whose instances follow one another. `found` is what looks at a thread's own instance have found, `parts` where its parts begin, 0 for one that is
// not to be looked at.
fn look_at_parts(found: u32, parts: u32, index: u32, lane: u32) -> u32 {
    let is_shown = found == LOOK_SHOWS && parts != 0u;
    atomicStore(&shows[lane], 0u);
    if is_shown {
        shown_lanes[atomicAdd(&shown_count, 1u)] = lane;
    }
    workgroupBarrier();
    let count = atomicLoad(&shown_count);
    // The first part of each, then the second of each: the largest come first, and what shows needs no more. All threads take as many steps.
    for (var begin = 0u; begin < count * MOST_PARTS; begin += 64u) {
        let item = begin + lane;
        let number = item / count;
        let other = shown_lanes[item % count];
        if number < MOST_PARTS && atomicLoad(&shows[other]) == 0u {
            let instance = instances[index - lane + other];
            let first = instance.traits >> 8u;
            if number < parts_from(first) && look_once(part_of(relative_box(instance), first + number)) != LOOK_HIDDEN {
                atomicStore(&shows[other], 1u);
            }
        }
    }
    workgroupBarrier();
    return select(found, LOOK_HIDDEN, is_shown && atomicLoad(&shows[lane]) == 0u);
}
