//!import identified
//!import packed_id
// The entity-id buffer: slot + 1 in each sample, 0 where nothing is drawn. The oracle compares these buffers; counting by histogram needs only
// this geometry pass.

@fragment
fn fragment(in: Varying) -> @location(0) vec2<u32> {
    return packed_id(in.slot + 1u);
}

@fragment
fn masked_fragment(in: MaskedVarying) -> @location(0) vec2<u32> {
    if is_cut_out(in) {
        discard;
    }
    return packed_id(in.slot + 1u);
}
