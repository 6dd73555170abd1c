// Scatters the results of hardware queries from query order to slot order: 1 where any sample passed. For on-gpu strategies only; on the host,
// an index does the same.

struct Settings {
    queries: u32,
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
}

@group(0) @binding(0) var<storage, read> settings: Settings;
// The slot of each query.
@group(0) @binding(1) var<storage, read> asked: array<u32>;
// Each result is a u64: zero, or something else.
@group(0) @binding(2) var<storage, read> answers: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read_write> counts: array<u32>;

@compute @workgroup_size(64)
fn scatter(@builtin(global_invocation_id) at: vec3<u32>) {
    if at.x < settings.queries {
        let answer = answers[at.x];
        counts[asked[at.x]] = select(0u, 1u, (answer.x | answer.y) != 0u);
    }
}
