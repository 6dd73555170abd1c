// What a test of boxes found about a slot, as the next frame goes by it.

// It was not tested: it was outside of the frustum, or was not there.
const SLOT_UNKNOWN: u32 = 0u;
const SLOT_VISIBLE: u32 = 1u;
const SLOT_HIDDEN: u32 = 2u;
