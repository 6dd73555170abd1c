//!import position
//!import material
//!import light
// The shaded pass: base colour, Lambert and Blinn-Phong, alpha mask and blend.

// 0 opaque, 1 mask, 2 blend; a constant a pipeline, so that opaque geometry keeps its early depth test.
override alpha_mode: u32 = 0u;

struct Varying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) relative: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) colour: vec4<f32>,
    @location(4) @interpolate(flat) material: u32,
}

@vertex
fn vertex(
    @location(0) local: vec3<f32>,
    @location(1) slot: u32,
    @location(2) normal: vec4<f32>,
    @location(3) uv: vec2<f32>,
    @location(4) colour: vec4<f32>,
) -> Varying {
    let instance = instances[slot];
    var out: Varying;
    out.relative = relative_position(instance, local);
    out.clip = clip_position(out.relative);
    // Normals go by the cofactor matrix: right for every scale, mirrored and zero ones included.
    let x = instance.row_x.xyz;
    let y = instance.row_y.xyz;
    let z = instance.row_z.xyz;
    let turned = vec3<f32>(dot(cross(y, z), normal.xyz), dot(cross(z, x), normal.xyz), dot(cross(x, y), normal.xyz));
    let mirrored = dot(x, cross(y, z)) < 0.0;
    out.normal = select(turned, -turned, mirrored);
    out.uv = uv;
    out.colour = colour;
    out.material = instance.material;
    return out;
}

@fragment
fn fragment(in: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let material = materials[in.material];
    let base = base_colour(material, in.uv, in.colour);
    if alpha_mode == ALPHA_MASK && base.a < material.alpha_cutoff {
        discard;
    }
    let alpha = select(1.0, base.a, alpha_mode == ALPHA_BLEND);
    if material.unlit != 0u {
        return vec4<f32>(base.rgb, alpha);
    }
    var normal = in.normal;
    let size = dot(normal, normal);
    let eye = -normalize(in.relative);
    // A mesh without normals, or a collapsed one, is lit as if it faced the eye.
    normal = select(eye, normal * inverseSqrt(size), size > 1e-30);
    normal = select(-normal, normal, front);
    return vec4<f32>(lit(base.rgb, normal, eye, in.relative), alpha);
}
