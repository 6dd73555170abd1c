//!import threshold
// Finds the highest threshold that leaves out no more visible samples than allowed, from counts that stay on the GPU.
// One workgroup: a histogram of the counts, then prefix sums over it. Entities with the fewest visible samples are left out first.
// All lanes run each loop equally often: on Mesa's GL, lanes that leave a loop before their neighbours execute nothing after it.

struct Settings {
    // Number of judged entities.
    count: u32,
    // Visible samples that may be left out, in total.
    allowed: u32,
    // The threshold that holds whatever is allowed.
    least: u32,
    padding: u32,
}

const LANES: u32 = 64u;
// The allowance leaves out no entity with more visible samples than this.
const LARGEST: u32 = 1024u;
// Histogram bins a lane; lane 0 starts at a count of 1.
const EACH: u32 = LARGEST / LANES;

@group(0) @binding(0) var<storage, read> settings: Settings;
// Slots of the judged entities.
@group(0) @binding(1) var<storage, read> judged: array<u32>;
// Visible samples by slot.
@group(0) @binding(2) var<storage, read> counts: array<u32>;
@group(0) @binding(3) var<storage, read_write> adapted: AdaptedThreshold;

// How many judged entities have a count of index + 1.
var<workgroup> histogram: array<atomic<u32>, LARGEST>;
var<workgroup> sums: array<u32, LANES>;
var<workgroup> highest: array<u32, LANES>;

// Saturating addition.
fn plus(a: u32, b: u32) -> u32 {
    return select(a + b, 0xffffffffu, a + b < a);
}

// Visible samples of a judged entity; 0 past the end of the list.
fn samples(at: u32) -> u32 {
    if at < settings.count {
        return counts[judged[at]];
    }
    return 0u;
}

// Sum of the visible samples of all entities that have exactly `count` of them, saturating.
fn samples_in_bin(count: u32) -> u32 {
    let number = atomicLoad(&histogram[count - 1u]);
    return select(number * count, 0xffffffffu, number > 0xffffffffu / count);
}

@compute @workgroup_size(LANES)
fn adapt_threshold(@builtin(local_invocation_index) lane: u32) {
    for (var start = 0u; start < settings.count; start += LANES) {
        let count = samples(start + lane);
        if count > 0u && count <= LARGEST {
            atomicAdd(&histogram[count - 1u], 1u);
        }
    }
    workgroupBarrier();
    let first = lane * EACH + 1u;
    var sum = 0u;
    for (var count = first; count < first + EACH; count++) {
        sum = plus(sum, samples_in_bin(count));
    }
    sums[lane] = sum;
    workgroupBarrier();
    sum = 0u;
    for (var other = 0u; other < LANES; other++) {
        sum = plus(sum, select(0u, sums[other], other < lane));
    }
    var fits = 0u;
    for (var count = first; count < first + EACH; count++) {
        let more = samples_in_bin(count);
        sum = plus(sum, more);
        fits = select(fits, count, more > 0u && sum <= settings.allowed);
    }
    highest[lane] = fits;
    workgroupBarrier();
    var threshold = settings.least;
    for (var other = 0u; other < LANES; other++) {
        threshold = max(threshold, highest[other]);
    }
    sum = 0u;
    for (var start = 0u; start < settings.count; start += LANES) {
        let count = samples(start + lane);
        sum += select(0u, count, count <= threshold);
    }
    // `sums` is reused: every lane has read its previous values before the last barrier.
    sums[lane] = sum;
    workgroupBarrier();
    if lane == 0u {
        var left_out = 0u;
        for (var other = 0u; other < LANES; other++) {
            left_out += sums[other];
        }
        adapted = AdaptedThreshold(0u, threshold, left_out, 0u);
    }
}
