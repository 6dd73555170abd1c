//!import relative_box
// The boxes of the parts of a mesh: each within the box around all of it.

// Ten bits for each axis, from one end of the mesh's box to the other: where the part begins, and where it ends. The upper two bits of both: how many parts follow in the mesh.
@group(0) @binding(9) var<storage, read> part_boxes: array<vec2<u32>>;

// How many parts a mesh has, whose first is this.
fn parts_from(first: u32) -> u32 {
    let packed = part_boxes[first];
    return select((packed.x >> 30u) + ((packed.y >> 30u) << 2u) + 1u, 0u, first == 0u);
}

// The box of a part in the box around all of them. Its reach is that of all of them: rounding errors grow with it.
fn part_of(whole: RelativeBox, number: u32) -> RelativeBox {
    let packed = part_boxes[number];
    let shifts = vec3<u32>(0u, 10u, 20u);
    let low = vec3<f32>((vec3<u32>(packed.x) >> shifts) & vec3<u32>(1023u)) / 1023.0;
    let high = vec3<f32>((vec3<u32>(packed.y) >> shifts) & vec3<u32>(1023u)) / 1023.0;
    let middle = low + high - 1.0;
    let half = high - low;
    var part = whole;
    part.centre = whole.centre + whole.x * middle.x + whole.y * middle.y + whole.z * middle.z;
    part.x = whole.x * half.x;
    part.y = whole.y * half.y;
    part.z = whole.z * half.z;
    part.round = 0.0;
    return part;
}
