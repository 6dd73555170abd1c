//!import threshold
//!import prefix_sum
// Makes the visible set on the GPU by stream compaction: keeps the candidates of each batch whose visible samples are within its bounds, in
// order, and writes the batch's indirect draw. One workgroup for each batch, so the order, which decides ties of depth, is the same in each run.

struct Batch {
    first: u32,
    count: u32,
    index_count: u32,
    first_index: u32,
    base_vertex: i32,
    // An entity is kept if it has more visible samples than both `over` and the threshold, and at most `most`.
    over: u32,
    most: u32,
    // If not 0, an entity is kept if it has no visible sample.
    hidden: u32,
}

struct Draw {
    index_count: u32,
    instance_count: u32,
    first_index: u32,
    base_vertex: i32,
    first_instance: u32,
}

struct Settings {
    // Number of batches.
    count: u32,
    // 0: a frame with a fixed threshold binds these words as its `AdaptedThreshold`.
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
}

// Flags of a candidate's entry. FORCED: it was not tested, so it is kept. BARRED: another batch draws it, so it is not kept.
const FORCED: u32 = 0x80000000u;
const BARRED: u32 = 0x40000000u;

@group(0) @binding(0) var<storage, read> settings: Settings;
@group(0) @binding(1) var<storage, read> batches: array<Batch>;
@group(0) @binding(2) var<storage, read> candidates: array<u32>;
@group(0) @binding(3) var<storage, read> counts: array<u32>;
@group(0) @binding(4) var<storage, read_write> kept: array<u32>;
@group(0) @binding(5) var<storage, read_write> draws: array<Draw>;
@group(0) @binding(6) var<storage, read> adapted: AdaptedThreshold;

// Candidates in a row that one thread looks at, so that a prefix sum is for so many more of them.
const RUN: u32 = 8u;

@compute @workgroup_size(64)
fn compact(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let index = group.y * groups.x + group.x;
    if index >= settings.count {
        return;
    }
    let batch = batches[index];
    var written = 0u;
    for (var start = 0u; start < batch.count; start += 64u * RUN) {
        let own = start + lane * RUN;
        var keep = 0u;
        for (var at = 0u; at < RUN; at++) {
            if own + at < batch.count {
                let entry = candidates[batch.first + own + at];
                let samples = counts[entry & ~(FORCED | BARRED)];
                let within = select(samples > max(batch.over, adapted.threshold) && samples <= batch.most, samples == 0u, batch.hidden != 0u);
                let keeps = (entry & FORCED) != 0u || (within && (entry & BARRED) == 0u);
                keep |= select(0u, 1u, keeps) << at;
            }
        }
        let sum = prefix_sum(lane, countOneBits(keep));
        var place = batch.first + written + sum.up_to_own - countOneBits(keep);
        for (var at = 0u; at < RUN; at++) {
            if ((keep >> at) & 1u) != 0u {
                kept[place] = candidates[batch.first + own + at] & ~(FORCED | BARRED);
                place++;
            }
        }
        written += sum.all;
    }
    if lane == 0u {
        draws[index] = Draw(batch.index_count, written, batch.first_index, batch.base_vertex, batch.first);
    }
}
