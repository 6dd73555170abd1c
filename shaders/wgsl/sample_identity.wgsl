//!import identified
// The entity ids of one of a pixel's samples: slot + 1, one byte a channel. Only this sample is drawn, and the other samples stay zero, so that
// resolving the texture gives the bytes divided by the number of samples: halves hold that exactly. Integers cannot be resolved, and OpenGL cannot
// read samples that were drawn.

// The sample, from 0.
override sample: u32 = 0u;

fn id_bytes(id: u32) -> vec4<f32> {
    let bytes = (vec4<u32>(id) >> vec4<u32>(0u, 8u, 16u, 24u)) & vec4<u32>(0xffu);
    return vec4<f32>(bytes);
}

struct Drawn {
    @builtin(sample_mask) mask: u32,
    @location(0) id: vec4<f32>,
}

// Runs once a pixel, as in the shaded pass, so that masks fall alike.
@fragment
fn fragment(in: Varying) -> Drawn {
    return Drawn(1u << sample, id_bytes(in.slot + 1u));
}

@fragment
fn masked_fragment(in: MaskedVarying) -> Drawn {
    if is_cut_out(in) {
        discard;
    }
    return Drawn(1u << sample, id_bytes(in.slot + 1u));
}

// For OpenGL, where naga cannot write a sample mask. Runs once a sample: the edge of a mask may fall otherwise within a pixel.
@fragment
fn fragment_of_samples(in: Varying, @builtin(sample_index) number: u32) -> @location(0) vec4<f32> {
    if number != sample {
        discard;
    }
    return id_bytes(in.slot + 1u);
}

@fragment
fn masked_fragment_of_samples(in: MaskedVarying, @builtin(sample_index) number: u32) -> @location(0) vec4<f32> {
    // It samples: `||` would leave it to some fragments alone.
    let cut_out = is_cut_out(in);
    if number != sample || cut_out {
        discard;
    }
    return id_bytes(in.slot + 1u);
}
