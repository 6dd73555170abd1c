//!import patch
// Marks the pixels of a patch in which a mesh is visible, under a forced early depth test.

// Without the forced early test, hidden fragments would leave marks too: a shader that writes memory runs before the depth test.
@fragment @early_depth_test(force)
fn fragment(in: Varying) {
    mark(in.patch_number, in.clip);
}

@fragment @early_depth_test(force)
fn textured_fragment(in: TexturedVarying) {
    if is_there(in) {
        mark(in.patch_number, in.clip);
    }
}

// For several samples a pixel. Reading the sample's number makes the shader run once for each sample that passes: once a pixel, llvmpipe runs it also
// where the mesh covers only samples that fail.
@fragment @early_depth_test(force)
fn fragment_of_samples(in: Varying, @builtin(sample_index) number: u32) {
    if number < 32u {
        mark(in.patch_number, in.clip);
    }
}

@fragment @early_depth_test(force)
fn textured_fragment_of_samples(in: TexturedVarying, @builtin(sample_index) number: u32) {
    // It samples: behind `&&` not all fragments might.
    if is_there(in) && number < 32u {
        mark(in.patch_number, in.clip);
    }
}
