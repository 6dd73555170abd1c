//!import eye_relative
//!import judged_instance
// A judged instance's box as the eye of `view` sees it.

// A box relative to the eye.
struct RelativeBox {
    centre: vec3<f32>,
    x: vec3<f32>,
    y: vec3<f32>,
    z: vec3<f32>,
    // The greatest absolute coordinates that occur on the way.
    reach: vec3<f32>,
    // What is in it lies in the ellipsoid whose half axes are the half edges times this; 0: it may fill the box.
    round: f32,
}

fn relative_box(instance: JudgedInstance) -> RelativeBox {
    let high = vec3<f32>(instance.row_x.w, instance.row_y.w, instance.row_z.w);
    var made: RelativeBox;
    made.centre = eye_relative(high, instance.centre_low);
    made.x = vec3<f32>(instance.row_x.x, instance.row_y.x, instance.row_z.x);
    made.y = vec3<f32>(instance.row_x.y, instance.row_y.y, instance.row_z.y);
    made.z = vec3<f32>(instance.row_x.z, instance.row_y.z, instance.row_z.z);
    made.reach = abs(made.centre) + abs(made.x) + abs(made.y) + abs(made.z);
    let steps = (instance.traits >> 3u) & 31u;
    made.round = select(0.0, 1.0 + (f32(steps) - 1.0) * 0.025, steps > 0u);
    return made;
}
