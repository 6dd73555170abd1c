// An entity's instance data: the rows of its linear transform with the origin's high parts in w, and the origin's low parts.
struct Instance {
    row_x: vec4<f32>,
    row_y: vec4<f32>,
    row_z: vec4<f32>,
    origin_low: vec3<f32>,
    material: u32,
}

@group(0) @binding(1) var<storage, read> instances: array<Instance>;
