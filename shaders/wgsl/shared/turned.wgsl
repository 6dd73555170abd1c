// What became of a frame's threshold where it is turned on the GPU. Where it is not, any words do whose second and third are what this holds then.
struct Turned {
    padding_a: u32,
    // Visible samples that an entity needs more than.
    threshold: u32,
    // Visible samples of all that it leaves out.
    left_out: u32,
    padding_b: u32,
}
