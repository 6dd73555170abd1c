//!import counted
// Counts visible samples with fragment atomics: each fragment that passes the forced early depth test adds one to its slot.

// Without the forced early test, hidden fragments would be counted too: a shader that writes memory runs before the depth test.
@fragment @early_depth_test(force)
fn fragment(in: Varying) {
    atomicAdd(&counts[in.slot], 1u);
}

// For several samples a pixel. Reading the sample's number makes the shader run once for each sample that passes.
@fragment @early_depth_test(force)
fn fragment_of_samples(in: Varying, @builtin(sample_index) number: u32) {
    atomicAdd(&counts[in.slot], min(number + 1u, 1u));
}
