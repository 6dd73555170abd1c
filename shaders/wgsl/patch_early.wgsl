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
