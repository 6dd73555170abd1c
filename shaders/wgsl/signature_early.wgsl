//!import transparent_sums
// The oracle's record of transparent entities with several samples a pixel, under a forced early depth test. Reading the sample's number makes the
// shader run once for each sample that passes.

@fragment @early_depth_test(force)
fn fragment_of_samples(in: Varying, @builtin(sample_index) number: u32) {
    note(in, number < 32u);
}
