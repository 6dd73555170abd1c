//!import look_together
//!import look_at_parts
//!import screen_size
//!import slot_states
// What a test of its box finds about a slot.

// Up to this size, in pixels, an instance's parts are looked at. A large one covers many pixels, and so do its parts: each of them is a long look.
const LARGEST_IN_PARTS: f32 = 16.0;

// For all threads of a workgroup at once, whose slots follow one another. A slot that is not `wanted` is not tested. Bits 8 and up of its traits say where the parts of its mesh begin.
fn state_of(slot: u32, lane: u32, wanted: bool) -> u32 {
    var state = SLOT_UNKNOWN;
    var found = LOOK_SHOWS;
    var parts = 0u;
    if wanted {
        let instance = instances[slot];
        let box = relative_box(instance);
        let at = place_of(box);
        if (instance.traits & LIVE) != 0u && at != BEYOND {
            state = SLOT_VISIBLE;
            if at == WITHIN && (instance.traits & TESTED) != 0u {
                found = look(box);
                let size = screen_size(box);
                let is_worthwhile = max(size.x, size.y) < LARGEST_IN_PARTS && (view.flags & WHOLE_BOXES) == 0u;
                parts = select(0u, instance.traits >> 8u, is_worthwhile);
            }
        }
    }
    found = look_together(found, slot, lane);
    found = look_at_parts(found, parts, slot, lane);
    return select(state, SLOT_HIDDEN, found == LOOK_HIDDEN);
}
