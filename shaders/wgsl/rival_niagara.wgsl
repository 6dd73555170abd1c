//!import rival_slots
// niagara's occlusion test, as a yardstick (zeux, drawcull and math.h). A sphere's exact rectangle (Mara and McGuire, 2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere, 2013), one
// sample at its middle through a sampler with minimum reduction, and the depth of the sphere's nearest point.

// Last frame's bits are drawn without a test, and everything is tested afterwards.
const PASSED_IS_VISIBLE: bool = false;

// The tangents of the two lines from the eye that touch a circle, which lies before the eye: `across` and `ahead` are its middle.
fn tangents(across: f32, ahead: f32, radius: f32) -> vec2<f32> {
    // The length of a tangent, and the direction of the middle turned by the angle of the circle.
    let tangent = sqrt(across * across + ahead * ahead - radius * radius);
    let low = (tangent * across - radius * ahead) / (tangent * ahead + radius * across);
    let high = (tangent * across + radius * ahead) / (tangent * ahead - radius * across);
    return vec2<f32>(low, high);
}

fn is_visible(place: RelativeBox) -> bool {
    let radius = sphere_radius(place);
    let centre = (view.view_from_relative * vec4<f32>(place.centre, 1.0)).xyz * vec3<f32>(1.0, 1.0, -1.0);
    let near = view.clip_from_view[3].z;
    // It knows perspective views on the axis, with a near plane that is parallel to the image. A sphere across that is visible.
    if view.on_axis == 0u || !(centre.z >= radius + near) {
        return true;
    }
    let x = tangents(centre.x, centre.z, radius) * view.clip_from_view[0].x;
    let y = tangents(centre.y, centre.z, radius) * view.clip_from_view[1].y;
    let low = vec2<f32>(x.x, -y.y) * 0.5 + 0.5;
    let high = vec2<f32>(x.y, -y.x) * 0.5 + 0.5;
    let extent = (high - low) * level_size(0u);
    var level = min(level_for(max(extent.x, extent.y)), pyramid.count - 1u);
    if level > 0u && fits_four(level - 1u, low, high) {
        level -= 1u;
    }
    return near / (centre.z - radius) > sampled_farthest(level, (low + high) * 0.5);
}
