// The adaptive threshold of one frame, as `adapt_threshold.wgsl` writes it.
// A frame with a fixed threshold binds another buffer in its place. Only the second and the third word are read.
struct AdaptedThreshold {
    padding_a: u32,
    // An entity is drawn when it has more visible samples than this.
    threshold: u32,
    // Sum of the visible samples of all entities that the threshold leaves out.
    left_out: u32,
    padding_b: u32,
}
