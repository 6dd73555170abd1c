//!import position
//!import material
// The geometry of entity-id passes: vertex stages with and without an alpha mask, and the mask.

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
    out.uv = image_place(instances[slot].material, uv);
    out.colour = colour;
    return out;
}

// Whether the mask leaves nothing of a fragment. It samples, so all fragments must call it.
fn is_cut_out(in: MaskedVarying) -> bool {
    let material = materials[instances[in.slot].material];
    return base_colour(material, in.uv, in.colour).a < material.alpha_cutoff;
}
