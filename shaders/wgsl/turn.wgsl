//!import turned
// A threshold as high as an allowance lets it be, by counts that stay on the GPU: of those with the fewest visible samples as many as share no more
// than is allowed. One workgroup: how many have each count, then sums over counts. All lanes go round a loop equally often: on Mesa's GL those that
// leave one before their neighbours do nothing any more.

struct Settings {
    // Entities that are judged.
    count: u32,
    // Visible samples that may be left out.
    allowed: u32,
    // The threshold that holds whatever is allowed.
    least: u32,
    padding: u32,
}

const LANES: u32 = 64u;
// Nobody with more visible samples is left out by an allowance.
const LARGEST: u32 = 1024u;
// Counts a lane, from 1 on.
const EACH: u32 = LARGEST / LANES;

@group(0) @binding(0) var<storage, read> settings: Settings;
@group(0) @binding(1) var<storage, read> judged: array<u32>;
// Visible samples by slot.
@group(0) @binding(2) var<storage, read> counts: array<u32>;
@group(0) @binding(3) var<storage, read_write> turned: Turned;

var<workgroup> having: array<atomic<u32>, LARGEST>;
var<workgroup> sums: array<u32, LANES>;
var<workgroup> highest: array<u32, LANES>;

fn plus(a: u32, b: u32) -> u32 {
    return select(a + b, 0xffffffffu, a + b < a);
}

// Visible samples of one that is judged; none beyond the last.
fn samples(at: u32) -> u32 {
    if at < settings.count {
        return counts[judged[at]];
    }
    return 0u;
}

// Samples that all who have so many share.
fn shared_by(count: u32) -> u32 {
    let number = atomicLoad(&having[count - 1u]);
    return select(number * count, 0xffffffffu, number > 0xffffffffu / count);
}

@compute @workgroup_size(LANES)
fn turn(@builtin(local_invocation_index) lane: u32) {
    for (var start = 0u; start < settings.count; start += LANES) {
        let count = samples(start + lane);
        if count > 0u && count <= LARGEST {
            atomicAdd(&having[count - 1u], 1u);
        }
    }
    workgroupBarrier();
    let first = lane * EACH + 1u;
    var sum = 0u;
    for (var count = first; count < first + EACH; count++) {
        sum = plus(sum, shared_by(count));
    }
    sums[lane] = sum;
    workgroupBarrier();
    sum = 0u;
    for (var other = 0u; other < LANES; other++) {
        sum = plus(sum, select(0u, sums[other], other < lane));
    }
    var fits = 0u;
    for (var count = first; count < first + EACH; count++) {
        let more = shared_by(count);
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
    // All have read what was in them before.
    sums[lane] = sum;
    workgroupBarrier();
    if lane == 0u {
        var left_out = 0u;
        for (var other = 0u; other < LANES; other++) {
            left_out += sums[other];
        }
        turned = Turned(0u, threshold, left_out, 0u);
    }
}
