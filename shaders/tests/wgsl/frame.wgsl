// A shared file of the tests.
struct Frame {
    time: f32,
}

@group(0) @binding(3) var<uniform> frame: Frame;
