// The environment map: an octahedral map (Praun and Hoppe, Spherical Parametrization and Remeshing, 2003) whose mip levels are prefiltered for
// rougher surfaces. A lookup needs no angles and no derivatives.

@group(3) @binding(0) var environment_texture: texture_2d<f32>;
@group(3) @binding(1) var environment_sampler: sampler;

// The roughest level: the irradiance of a surface.
const ENVIRONMENT_ROUGHEST: f32 = 5.0;
const ENVIRONMENT_ROUGHEST_INSET: f32 = 0.4375;

// Linear light from a direction, which may have any length. `inset` is the distance of the outermost texels' centres from the level's middle.
// They are on the map's edge, so that both sides of the edge have the same values.
fn environment(towards: vec3<f32>, level: f32, inset: f32) -> vec3<f32> {
    let size = abs(towards);
    let flat = towards.xz / (size.x + size.y + size.z);
    let folded = (vec2<f32>(1.0) - abs(flat.yx)) * select(vec2<f32>(-1.0), vec2<f32>(1.0), flat >= vec2<f32>(0.0));
    let place = select(folded, flat, towards.y >= 0.0);
    let root = textureSampleLevel(environment_texture, environment_sampler, vec2<f32>(0.5) + place * inset, level).rgb;
    // The texture holds square roots: they make eight bits precise enough for dark values, and squaring is cheap.
    return root * root;
}
