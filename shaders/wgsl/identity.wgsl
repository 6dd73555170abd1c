//!import position
//!import material
// The entity-id buffer: slot + 1 in each pixel, 0 where nothing is drawn. The oracle compares these buffers; counting by histogram needs only
// this geometry pass.

struct Varying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) slot: u32,
}

@vertex
fn vertex(@location(0) local: vec3<f32>, @location(1) slot: u32) -> Varying {
    var out: Varying;
    out.clip = clip_position(relative_position(instances[slot], local));
    out.slot = slot;
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) u32 {
    return in.slot + 1u;
}

struct MaskedVarying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) slot: u32,
    @location(1) uv: vec2<f32>,
    @location(2) colour: vec4<f32>,
}

@vertex
fn masked_vertex(
    @location(0) local: vec3<f32>,
    @location(1) slot: u32,
    @location(2) normal: vec4<f32>,
    @location(3) uv: vec2<f32>,
    @location(4) colour: vec4<f32>,
) -> MaskedVarying {
    var out: MaskedVarying;
    out.clip = clip_position(relative_position(instances[slot], local));
    out.slot = slot;
    out.uv = uv;
    out.colour = colour;
    return out;
}

@fragment
fn masked_fragment(in: MaskedVarying) -> @location(0) u32 {
    let material = materials[instances[in.slot].material];
    let base = base_colour(material, in.uv, in.colour);
    if base.a < material.alpha_cutoff {
        discard;
    }
    return in.slot + 1u;
}
