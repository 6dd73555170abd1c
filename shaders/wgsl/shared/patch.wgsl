//!import position
//!import material
//!import marks
// Draws meshes again into patches of the image, to find the pixels in which they are visible: the vertex stage, and the mark of a visible
// fragment.

// Words a patch, see `marks.wgsl`.
@group(3) @binding(0) var<storage, read_write> shown: array<atomic<u32>>;

struct Varying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) patch_number: u32,
}

struct TexturedVarying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) patch_number: u32,
    @location(1) @interpolate(flat) slot: u32,
    @location(2) uv: vec2<f32>,
    @location(3) colour: vec4<f32>,
}

@vertex
fn vertex(@location(0) local: vec3<f32>, @location(1) slot: u32, @location(5) patch_number: u32) -> Varying {
    var out: Varying;
    out.clip = clip_position(relative_position(instances[slot], local));
    out.patch_number = patch_number;
    return out;
}

@vertex
fn textured_vertex(
    @location(0) local: vec3<f32>,
    @location(1) slot: u32,
    @location(2) normal: vec4<f32>,
    @location(3) uv: vec2<f32>,
    @location(4) colour: vec4<f32>,
    @location(5) patch_number: u32,
) -> TexturedVarying {
    var out: TexturedVarying;
    out.clip = clip_position(relative_position(instances[slot], local));
    out.patch_number = patch_number;
    out.slot = slot;
    out.uv = image_place(instances[slot].material, uv);
    out.colour = colour;
    return out;
}

// Whether a fragment of a masked or blended surface is visible. It samples, so all fragments must call it. Less than half of an 8-bit step does not change the image.
fn is_there(in: TexturedVarying) -> bool {
    let material = materials[instances[in.slot].material];
    let base = base_colour(material, in.uv, in.colour);
    return base.a >= max(material.alpha_cutoff, 0.002);
}

fn mark(numbered: u32, clip: vec4<f32>) {
    let pixel = vec2<u32>(clip.xy);
    // With several samples a pixel, llvmpipe's scissor lets in those of the pixels to the left and above.
    if patch_parity(pixel) != (numbered & PARITY) {
        return;
    }
    let patch_number = numbered & ~PARITY;
    let place = pixel % PATCH;
    let bit = place.y * PATCH + place.x;
    atomicOr(&shown[patch_number * WORDS + bit / 32u], 1u << (bit % 32u));
}
