//! Half-edge numbering: half-edge `3 t + k` is the side of triangle `t` that starts at its corner `k`.

/// The index that stands for "no triangle", "no edge", "no group" and "no vertex".
pub const NONE: u32 = u32::MAX;

/// The next side of the same triangle, counter-clockwise.
#[must_use]
pub fn next(half_edge: u32) -> u32 {
    if half_edge % 3 == 2 {
        half_edge - 2
    } else {
        half_edge + 1
    }
}

/// The side before this one in the same triangle.
#[must_use]
pub fn prev(half_edge: u32) -> u32 {
    if half_edge.is_multiple_of(3) {
        half_edge + 2
    } else {
        half_edge - 1
    }
}
