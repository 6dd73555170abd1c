// A world position relative to the eye of `view`. Both are sums of two f32 a coordinate (high + low), and the difference is exact to about 48 bits only if each half is
// subtracted from its own kind. A compiler with fast maths may reassociate `(a - b) + (c - d)`, which costs up to 0.25 m at the radius of the Earth: the halves are joined first, and the sum has 24 bits.
// So what each subtraction gives is passed through the integers, where a compiler cannot follow it.
// (Relative to the eye with two floats a coordinate: Cozzi and Ring, 3D Engine Design for Virtual Globes, 2011, section 5.4.)

fn eye_relative(high: vec3<f32>, low: vec3<f32>) -> vec3<f32> {
    // The sign of a width: 0, which no compiler knows.
    let zero = vec3<u32>(bitcast<u32>(view.pixels_wide) >> 31u);
    let far = bitcast<vec3<u32>>(high - view.eye_high) ^ zero;
    let near = bitcast<vec3<u32>>(low - view.eye_low) ^ zero;
    return bitcast<vec3<f32>>(far) + bitcast<vec3<f32>>(near);
}
