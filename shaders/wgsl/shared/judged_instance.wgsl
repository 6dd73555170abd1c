// An instance that is judged, as hosts may write it too.

// An instance's box: half edges and centre. The centre is the sum of its high parts, in w of the rows, and its low parts.
struct JudgedInstance {
    row_x: vec4<f32>,
    row_y: vec4<f32>,
    row_z: vec4<f32>,
    centre_low: vec3<f32>,
    // Bits of `HIDES`, `TESTED` and `LIVE`; from bit 3 on five bits of how round it is; and from bit 8 on the generation of the index, or, where slots are tested, where the boxes of its parts begin.
    // The n-th step of roundness: it lies in the ellipsoid whose half axes are its half edges times 1 + (n - 1) / 40. 0: it may fill its box.
    traits: u32,
}

// It is drawn before the test, and may hide others.
const HIDES: u32 = 1u;
// It may be culled for being hidden.
const TESTED: u32 = 2u;
const LIVE: u32 = 4u;
