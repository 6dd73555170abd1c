// Materials: one storage buffer for the scene, and one texture and sampler for each batch.
const ALPHA_OPAQUE: u32 = 0u;
const ALPHA_MASK: u32 = 1u;
const ALPHA_BLEND: u32 = 2u;

struct Material {
    base_colour: vec4<f32>,
    // Rows of the 2x3 texture transform.
    uv_u: vec3<f32>,
    alpha_cutoff: f32,
    uv_v: vec3<f32>,
    unlit: u32,
    metallic: f32,
    roughness: f32,
    // The level of the environment map that a surface of this roughness reflects, and that level's inset.
    environment_level: f32,
    environment_inset: f32,
    // Linear light that the surface adds by itself.
    emission: vec3<f32>,
    padding: f32,
}

@group(1) @binding(0) var<storage, read> materials: array<Material>;
@group(2) @binding(0) var base_colour_texture: texture_2d<f32>;
@group(2) @binding(1) var base_colour_sampler: sampler;

// Whether materials have an image. A pipeline constant, so that pipelines without one do not sample.
override textured: bool = true;

// Where in the image a vertex is. Vertex stages call it, and not fragments: helper invocations need not get what buffers hold, so that a place which comes from a material there
// has no derivatives along the edges of triangles (Mesa's llvmpipe gives zeros).
fn image_place(material: u32, uv: vec2<f32>) -> vec2<f32> {
    let place = vec3<f32>(uv, 1.0);
    return vec2<f32>(dot(materials[material].uv_u, place), dot(materials[material].uv_v, place));
}

// `place` is an `image_place`.
fn base_colour(material: Material, place: vec2<f32>, vertex_colour: vec4<f32>) -> vec4<f32> {
    if !textured {
        return material.base_colour * vertex_colour;
    }
    return material.base_colour * vertex_colour * textureSample(base_colour_texture, base_colour_sampler, place);
}
