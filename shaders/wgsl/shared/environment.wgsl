// What surrounds the scene, folded from a sphere into a square (an octahedral map: Praun and Hoppe, Spherical Parametrization and
// Remeshing, 2003), each smaller copy blurred as a rougher surface blurs it. A look is a fold and a sample: no angles, no derivatives.

@group(3) @binding(0) var environment_texture: texture_2d<f32>;
@group(3) @binding(1) var environment_sampler: sampler;

// The copy that is blurred most: the light that falls on a surface from all sides.
const ENVIRONMENT_ROUGHEST: f32 = 5.0;
const ENVIRONMENT_ROUGHEST_INSET: f32 = 0.4375;

// Linear light from a direction of any length. `inset` is how far from the middle the outermost texels' centres lie in that copy:
// they lie on the fold, so that both of its sides have the same values.
fn environment(towards: vec3<f32>, level: f32, inset: f32) -> vec3<f32> {
    let size = abs(towards);
    let flat = towards.xz / (size.x + size.y + size.z);
    let folded = (vec2<f32>(1.0) - abs(flat.yx)) * select(vec2<f32>(-1.0), vec2<f32>(1.0), flat >= vec2<f32>(0.0));
    let place = select(folded, flat, towards.y >= 0.0);
    let root = textureSampleLevel(environment_texture, environment_sampler, vec2<f32>(0.5) + place * inset, level).rgb;
    // Square roots are kept: eight bits of them are enough in the dark, and squaring is cheap.
    return root * root;
}
