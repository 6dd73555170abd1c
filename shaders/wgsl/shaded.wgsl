//!import position
//!import material
//!import light
//!import environment
//!import packed_id
// The shaded pass: base colour, Lambert and Blinn-Phong, emission, alpha mask and blend and, with an environment, reflections of it. Meshes
// without normals are shaded flat.

// 0 opaque, 1 mask, 2 blend. A pipeline constant, so that opaque geometry keeps its early depth test.
override alpha_mode: u32 = 0u;

struct Varying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) relative: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) colour: vec4<f32>,
    @location(4) @interpolate(flat) material: u32,
}

fn surface(local: vec3<f32>, slot: u32, normal: vec4<f32>, uv: vec2<f32>, colour: vec4<f32>) -> Varying {
    let instance = instances[slot];
    var out: Varying;
    out.relative = relative_position(instance, local);
    out.clip = clip_position(out.relative);
    // Normals are transformed by the cofactor matrix, which is correct for every scale, negative and zero ones included.
    let x = instance.row_x.xyz;
    let y = instance.row_y.xyz;
    let z = instance.row_z.xyz;
    let cofactor = vec3<f32>(dot(cross(y, z), normal.xyz), dot(cross(z, x), normal.xyz), dot(cross(x, y), normal.xyz));
    let mirrored = dot(x, cross(y, z)) < 0.0;
    out.normal = select(cofactor, -cofactor, mirrored);
    out.uv = image_place(instance.material, uv);
    out.colour = colour;
    out.material = instance.material;
    return out;
}

@vertex
fn vertex(
    @location(0) local: vec3<f32>,
    @location(1) slot: u32,
    @location(2) normal: vec4<f32>,
    @location(3) uv: vec2<f32>,
    @location(4) colour: vec4<f32>,
) -> Varying {
    return surface(local, slot, normal, uv, colour);
}

// Specular reflectance of lights, for dielectrics.
const GLOSS: f32 = 0.12;
// Reflectance of the environment at normal incidence, for dielectrics.
const DIELECTRIC: f32 = 0.04;

// The unit normal of the plane in which the neighbouring pixels lie, on the eye's side: flat shading. For lines and points, which lie in none,
// the direction to the eye. It takes derivatives, so all pixels of a triangle must call it.
fn plane_normal(relative: vec3<f32>, eye: vec3<f32>) -> vec3<f32> {
    let right = dpdx(relative);
    let down = dpdy(relative);
    let lengths = vec2<f32>(dot(right, right), dot(down, down));
    // Of unit vectors, so that nothing overflows or vanishes at any scale of the scene.
    let across = cross(right * inverseSqrt(max(lengths.x, 1e-36)), down * inverseSqrt(max(lengths.y, 1e-36)));
    let size = dot(across, across);
    let unit = across * inverseSqrt(max(size, 1e-36));
    let towards_eye = select(-unit, unit, dot(unit, eye) > 0.0);
    return select(eye, towards_eye, size > 1e-6);
}

// `plane` is the normal where the mesh has none, or is scaled to zero.
fn facing(normal: vec3<f32>, plane: vec3<f32>, front: bool) -> vec3<f32> {
    let size = dot(normal, normal);
    let unit = normal * inverseSqrt(max(size, 1e-30));
    return select(plane, select(-unit, unit, front), size > 1e-30);
}

fn shade(in: Varying, front: bool) -> vec4<f32> {
    let material = materials[in.material];
    let base = base_colour(material, in.uv, in.colour);
    let eye = -normalize(in.relative);
    let plane = plane_normal(in.relative, eye);
    if alpha_mode == ALPHA_MASK && base.a < material.alpha_cutoff {
        discard;
    }
    let alpha = select(1.0, base.a, alpha_mode == ALPHA_BLEND);
    if material.unlit != 0u {
        return vec4<f32>(base.rgb, alpha);
    }
    let normal = facing(in.normal, plane, front);
    let start = base.rgb * lights.ambient + material.emission;
    return vec4<f32>(lit(start, base.rgb, vec3<f32>(GLOSS), normal, eye, in.relative), alpha);
}

// Shading with an environment: Fresnel reflection (Schlick, An Inexpensive BRDF Model for Physically-based Rendering, 1994), which decreases
// with roughness at grazing angles (Lagarde, Adopting a physically based shading model, 2011), and irradiance.
fn shade_reflecting(in: Varying, front: bool) -> vec4<f32> {
    let material = materials[in.material];
    let base = base_colour(material, in.uv, in.colour);
    let eye = -normalize(in.relative);
    let plane = plane_normal(in.relative, eye);
    if alpha_mode == ALPHA_MASK && base.a < material.alpha_cutoff {
        discard;
    }
    let alpha = select(1.0, base.a, alpha_mode == ALPHA_BLEND);
    if material.unlit != 0u {
        return vec4<f32>(base.rgb, alpha);
    }
    let normal = facing(in.normal, plane, front);
    let facing_eye = clamp(dot(normal, eye), 0.0, 1.0);
    let grazing = 1.0 - facing_eye;
    let grazing_squared = grazing * grazing;
    let straight = mix(vec3<f32>(DIELECTRIC), base.rgb, material.metallic);
    let more = max(vec3<f32>(1.0 - material.roughness) - straight, vec3<f32>(0.0));
    let reflected = straight + more * (grazing_squared * grazing_squared * grazing);
    let mirrored = environment(reflect(-eye, normal), material.environment_level, material.environment_inset);
    let irradiance = environment(normal, ENVIRONMENT_ROUGHEST, ENVIRONMENT_ROUGHEST_INSET);
    let diffuse = base.rgb * (1.0 - material.metallic);
    let gloss = mix(vec3<f32>(GLOSS), base.rgb, material.metallic);
    let start = (diffuse * irradiance + reflected * mirrored) * lights.ambient + material.emission;
    return vec4<f32>(lit(start, diffuse, gloss, normal, eye, in.relative), alpha);
}

@fragment
fn fragment(in: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return shade(in, front);
}

@fragment
fn reflecting_fragment(in: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return shade_reflecting(in, front);
}

// Shading with the entity's id in a second target, as in the entity-id buffer.
struct IdentifiedVarying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) relative: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) colour: vec4<f32>,
    @location(4) @interpolate(flat) material: u32,
    @location(5) @interpolate(flat) slot: u32,
}

struct Identified {
    @location(0) colour: vec4<f32>,
    @location(1) id: vec2<u32>,
}

@vertex
fn identified_vertex(
    @location(0) local: vec3<f32>,
    @location(1) slot: u32,
    @location(2) normal: vec4<f32>,
    @location(3) uv: vec2<f32>,
    @location(4) colour: vec4<f32>,
) -> IdentifiedVarying {
    let out = surface(local, slot, normal, uv, colour);
    return IdentifiedVarying(out.clip, out.relative, out.normal, out.uv, out.colour, out.material, slot);
}

fn without_slot(in: IdentifiedVarying) -> Varying {
    return Varying(in.clip, in.relative, in.normal, in.uv, in.colour, in.material);
}

@fragment
fn identified_fragment(in: IdentifiedVarying, @builtin(front_facing) front: bool) -> Identified {
    return Identified(shade(without_slot(in), front), packed_id(in.slot + 1u));
}

@fragment
fn identified_reflecting_fragment(in: IdentifiedVarying, @builtin(front_facing) front: bool) -> Identified {
    return Identified(shade_reflecting(without_slot(in), front), packed_id(in.slot + 1u));
}
