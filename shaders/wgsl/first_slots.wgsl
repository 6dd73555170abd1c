//!import screen_size
//!import slot_states
// Chooses what is drawn before the test of boxes, a word a slot, 1 or 0: what was visible in the last frame, what no test may cull, and what is large where nothing is known. Where
// nothing is drawn after the test, all that is drawn: also what is transparent, and what nothing is known of, unless that is to be culled.

// The states of the last frame.
@group(0) @binding(2) var<storage, read> states: array<u32>;
@group(0) @binding(3) var<storage, read_write> first: array<u32>;

// The least size on the screen, as a part of its width or height, at which an entity that nothing is known of is drawn before the test: it may hide much.
const LARGE: f32 = 0.035;

// Of what is smaller, by no more than this, one in four is drawn: in a crowd of equals they hide many of the others.
const SMALLER: f32 = 0.25;

fn is_guessed(place: RelativeBox, slot: u32) -> bool {
    let size = screen_size(place) / vec2<f32>(view.pixels_wide, view.pixels_high);
    return max(size.x, size.y) > LARGE * select(1.0, SMALLER, slot % 4u == 0u);
}

fn is_first(instance: JudgedInstance, slot: u32, state: u32) -> bool {
    let is_last_phase = (view.flags & FRAME_LATE) != 0u;
    // What hides nothing waits for the test, if there is one.
    let wanted = LIVE | select(HIDES, 0u, is_last_phase);
    if (instance.traits & wanted) != wanted {
        return false;
    }
    let place = relative_box(instance);
    let at = place_of(place);
    if at == WITHIN && (instance.traits & TESTED) != 0u {
        let known = select(state, SLOT_UNKNOWN, (view.flags & FORGET) != 0u);
        if known == SLOT_UNKNOWN {
            return select(is_guessed(place, slot), (view.flags & CULL_UNKNOWN) == 0u, is_last_phase);
        }
        return known == SLOT_VISIBLE;
    }
    return at != BEYOND;
}

@compute @workgroup_size(64)
fn first_slots(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    // More workgroups than a dimension of a dispatch may have come in rows.
    let slot = at.y * groups.x * 64u + at.x;
    if slot < view.count {
        first[slot] = select(0u, 1u, is_first(instances[slot], slot, states[slot]));
    }
}
