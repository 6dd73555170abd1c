//!import judged_instance
//!import relative_box
// Instances that are judged by their boxes, and the view that they are judged for. The view's matrix may be any: nothing here knows a near
// plane, a far plane or an eye but from the matrix.

struct JudgedView {
    // From world space relative to `eye` to clip space.
    clip_from_relative: mat4x4<f32>,
    eye_high: vec3<f32>,
    pixels_wide: f32,
    eye_low: vec3<f32>,
    pixels_high: f32,
    // 1: depth is reversed, greater is nearer. -1: forward. A depth times this is a nearness.
    towards: f32,
    // By how much a stored depth may differ from the depth that was drawn: a step of the format.
    depth_step: f32,
    // Number of instances.
    count: u32,
    // Bits of `FORGET` and the following.
    flags: u32,
    // By how many pixels the image may shift until the answers are used.
    shift: f32,
    // Where the eye goes: x, y and w of that direction in clip space. The greatest of them is by how many pixels what is hidden may go, relative to what hides it, until the answers are used.
    drift_x: f32,
    drift_y: f32,
    drift_w: f32,
}

// What is remembered of the instances belongs to another camera.
const FORGET: u32 = 1u;
// There is no second phase: what is not known to be hidden is drawn at once.
const FRAME_LATE: u32 = 2u;
// Everything is drawn with one sample a pixel, in its middle.
const AT_MIDDLES: u32 = 4u;
// What nothing is known of is not drawn before it was tested, where there is no second phase.
const CULL_UNKNOWN: u32 = 8u;
// Ellipsoids are not tested.
const BOXES_ALONE: u32 = 16u;
// Boxes of parts are not tested.
const WHOLE_BOXES: u32 = 64u;
// What the pyramid lets through at first sight is visible.
const ONE_LOOK: u32 = 32u;

// What is found about an instance. A state holds it, and from bit 8 on the generation that it is about.
const ABSENT: u32 = 0u;
const OUTSIDE: u32 = 1u;
const HIDDEN: u32 = 2u;
const VISIBLE: u32 = 3u;
// It is drawn whatever a test says: it crosses the near plane, or is not tested.
const EXEMPT: u32 = 4u;
// Nothing is known.
const NEW: u32 = 5u;

@group(0) @binding(0) var<uniform> view: JudgedView;
@group(0) @binding(1) var<storage, read> instances: array<JudgedInstance>;

// The error of the maths in f32, here and where the instances are drawn, as a fraction of the terms.
const ROUNDING: f32 = 1e-6;

// A row of the matrix: a clip coordinate as a function of the place.
fn clip_row(number: u32) -> vec4<f32> {
    let m = view.clip_from_relative;
    return vec4<f32>(m[0][number], m[1][number], m[2][number], m[3][number]);
}

// The least and the greatest value over a box of `row + sign * other`, two linear functions of the place, with the rounding error that each of them has by itself: what the sum cancels, a
// host has rounded before.
fn span(row: vec4<f32>, other: vec4<f32>, sign: f32, place: RelativeBox) -> vec2<f32> {
    let both = row + sign * other;
    let middle = dot(both.xyz, place.centre) + both.w;
    let half = abs(dot(both.xyz, place.x)) + abs(dot(both.xyz, place.y)) + abs(dot(both.xyz, place.z));
    let terms = abs(row) + abs(other);
    let error = ROUNDING * (dot(terms.xyz, place.reach) + terms.w);
    return vec2<f32>(middle - half - error, middle + half + error);
}

// Where a box is: outside of the view's volume, across its near plane or beside the eye, or neither.
const BEYOND: u32 = 0u;
const ACROSS: u32 = 1u;
const WITHIN: u32 = 2u;

fn place_of(place: RelativeBox) -> u32 {
    let x = clip_row(0u);
    let y = clip_row(1u);
    let z = clip_row(2u);
    let w = clip_row(3u);
    let from_left = span(w, x, 1.0, place);
    let from_right = span(w, x, -1.0, place);
    let from_bottom = span(w, y, 1.0, place);
    let from_top = span(w, y, -1.0, place);
    let upwards = span(z, z, 0.0, place);
    let downwards = span(w, z, -1.0, place);
    let most = min(min(min(from_left.y, from_right.y), min(from_bottom.y, from_top.y)), min(upwards.y, downwards.y));
    // Written so that what is not a number counts as across.
    if most < 0.0 {
        return BEYOND;
    }
    let from_near = select(upwards.x, downwards.x, view.towards > 0.0);
    let before_eye = span(w, w, 0.0, place).x;
    if from_near > 0.0 && before_eye > 0.0 {
        return WITHIN;
    }
    return ACROSS;
}

// What is known about an instance before this frame's test.
fn knowledge(instance: JudgedInstance, at: u32, state: u32) -> u32 {
    if (instance.traits & LIVE) == 0u {
        return ABSENT;
    }
    if at == BEYOND {
        return OUTSIDE;
    }
    if at == ACROSS || (instance.traits & TESTED) == 0u {
        return EXEMPT;
    }
    let before = state & 255u;
    if (view.flags & FORGET) != 0u || (state >> 8u) != (instance.traits >> 8u) || before == ABSENT {
        return NEW;
    }
    if before == OUTSIDE {
        // What comes in has not been tested. Where a test follows in this frame, it may wait for it.
        return select(HIDDEN, NEW, (view.flags & FRAME_LATE) != 0u);
    }
    return min(before, VISIBLE);
}
