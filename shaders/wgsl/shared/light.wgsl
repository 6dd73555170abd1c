// Up to eight lights: directional, positional, spot. Positions are relative to the eye.
const MAX_LIGHTS: u32 = 8u;
const LIGHT_DIRECTIONAL: u32 = 0u;
const LIGHT_POINT: u32 = 1u;
const LIGHT_SPOT: u32 = 2u;

struct Light {
    colour: vec3<f32>,
    kind: u32,
    // The direction in which the light shines, unit length.
    direction: vec3<f32>,
    // Metres; 0 means infinite.
    range: f32,
    position: vec3<f32>,
    cos_outer: f32,
    cos_inner: f32,
    // Distance in metres at which a positional light has the intensity of `colour`.
    reference_distance: f32,
    padding: vec2<f32>,
}

struct Lights {
    // Ambient light; where the scene has an environment, a factor for it.
    ambient: vec3<f32>,
    count: u32,
    lights: array<Light, 8>,
}

// Whether any light is positional. A pipeline constant, so that directional lights alone compute no distances.
override positional_lights: bool = true;

// A storage buffer, not a uniform: Mesa's lavapipe specialises loops for the values of uniforms in every draw, and keeps the memory.
@group(1) @binding(1) var<storage, read> lights: Lights;

// The light of a surface: `start` plus the diffuse (`base`) and the specular (`gloss`) reflection of all lights. Lambert and Blinn-Phong.
fn lit(
    start: vec3<f32>,
    base: vec3<f32>,
    gloss: vec3<f32>,
    normal: vec3<f32>,
    eye: vec3<f32>,
    relative: vec3<f32>,
) -> vec3<f32> {
    var sum = start;
    for (var i = 0u; i < min(lights.count, MAX_LIGHTS); i++) {
        let light = lights.lights[i];
        var towards = -light.direction;
        var strength = 1.0;
        if positional_lights && light.kind != LIGHT_DIRECTIONAL {
            let offset = light.position - relative;
            let distance_squared = max(dot(offset, offset), 1e-12);
            towards = offset * inverseSqrt(distance_squared);
            strength = light.reference_distance * light.reference_distance / distance_squared;
            if light.range > 0.0 {
                let part = distance_squared / (light.range * light.range);
                strength *= clamp(1.0 - part * part, 0.0, 1.0);
            }
        }
        if positional_lights && light.kind == LIGHT_SPOT {
            let cosine = dot(-towards, light.direction);
            strength *= smoothstep(light.cos_outer, light.cos_inner, cosine);
        }
        let lambert = max(dot(normal, towards), 0.0);
        let half_way = normalize(towards + eye);
        // The 32nd power by squaring.
        var shine = max(dot(normal, half_way), 0.0);
        shine *= shine;
        shine *= shine;
        shine *= shine;
        shine *= shine;
        shine *= shine;
        let mirrored = select(0.0, shine, lambert > 0.0);
        sum += light.colour * strength * (base * lambert + gloss * mirrored);
    }
    return sum;
}
