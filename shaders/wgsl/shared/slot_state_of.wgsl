//!import look_together
//!import slot_states
// What a test of its box finds about a slot.

// For all threads of a workgroup at once, whose slots follow one another. A slot that is not `wanted` is not tested.
fn state_of(slot: u32, lane: u32, wanted: bool) -> u32 {
    var state = SLOT_UNKNOWN;
    var found = LOOK_SHOWS;
    if wanted {
        let instance = instances[slot];
        let box = relative_box(instance);
        let at = place_of(box);
        if (instance.traits & LIVE) != 0u && at != BEYOND {
            state = SLOT_VISIBLE;
            if at == WITHIN && (instance.traits & TESTED) != 0u {
                found = look(box);
            }
        }
    }
    found = look_together(found, slot, lane);
    return select(state, SLOT_HIDDEN, found == LOOK_HIDDEN);
}
