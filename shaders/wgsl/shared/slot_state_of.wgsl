//!import box_test
//!import slot_states
// What a test of its box finds about a slot.

fn state_of(instance: JudgedInstance) -> u32 {
    if (instance.traits & LIVE) == 0u {
        return SLOT_UNKNOWN;
    }
    let box = relative_box(instance);
    let at = place_of(box);
    if at == BEYOND {
        return SLOT_UNKNOWN;
    }
    if at == WITHIN && (instance.traits & TESTED) != 0u && !shows(box) {
        return SLOT_HIDDEN;
    }
    return SLOT_VISIBLE;
}
