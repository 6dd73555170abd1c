//!import threshold
//!import prefix_sum
// Makes the visible set on the GPU by stream compaction: keeps the candidates of each batch whose visible samples are within its bounds, in
// order, and writes the batch's indirect draw. Reduce, then scan (Blelloch, Prefix Sums and Their Applications, 1990): `mark` decides and counts by block, `scan` adds the blocks up,
// `gather` puts what is kept in its place. No workgroup waits for another, and the order, which decides ties of depth, is the same in each run.

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
    // Number of candidates.
    entries: u32,
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

// A word a thread of `mark`: in the low byte which of its candidates are kept, above it how many are kept before them in their block.
@group(0) @binding(7) var<storage, read_write> marks: array<u32>;
// After `mark`: how many candidates of a block are kept. After `scan`: how many are kept before the block.
@group(0) @binding(8) var<storage, read_write> blocks: array<u32>;

// Candidates in a row that one thread looks at, so that a prefix sum is for so many more of them.
const RUN: u32 = 8u;

// The batch that an entry lies in. The batches lie one after the other, and none is empty.
fn batch_at(entry: u32) -> u32 {
    var found = 0u;
    // All threads take the same steps: Mesa 22's llvmpipe loses those that leave a loop before the others.
    for (var length = settings.count; length > 1u; length -= length / 2u) {
        let half = length / 2u;
        found += select(0u, half, batches[found + half].first <= entry);
    }
    return found;
}

fn keeps(batch: Batch, entry: u32) -> bool {
    let samples = counts[entry & ~(FORCED | BARRED)];
    let within = select(samples > max(batch.over, adapted.threshold) && samples <= batch.most, samples == 0u, batch.hidden != 0u);
    return (entry & FORCED) != 0u || (within && (entry & BARRED) == 0u);
}

// A workgroup a block of 512 candidates.
@compute @workgroup_size(64)
fn mark(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let block = group.y * groups.x + group.x;
    let thread = block * 64u + lane;
    let own = thread * RUN;
    var kept_here = 0u;
    if own < settings.entries {
        var number = batch_at(own);
        var batch = batches[number];
        for (var at = 0u; at < RUN; at++) {
            if own + at < settings.entries {
                if own + at >= batch.first + batch.count {
                    number += 1u;
                    batch = batches[number];
                }
                kept_here |= select(0u, 1u, keeps(batch, candidates[own + at])) << at;
            }
        }
    }
    let count = countOneBits(kept_here);
    let sum = prefix_sum(lane, count);
    if own < settings.entries {
        marks[thread] = kept_here | ((sum.up_to_own - count) << 8u);
    }
    if lane == 0u && block * 64u * RUN < settings.entries {
        blocks[block] = sum.all;
    }
}

// One workgroup.
@compute @workgroup_size(64)
fn scan(@builtin(local_invocation_index) lane: u32) {
    let number = (settings.entries + 64u * RUN - 1u) / (64u * RUN);
    var before = 0u;
    for (var start = 0u; start < number; start += 64u * RUN) {
        let own = start + lane * RUN;
        var here = 0u;
        for (var at = own; at < own + RUN; at++) {
            if at < number {
                here += blocks[at];
            }
        }
        let sum = prefix_sum(lane, here);
        var place = before + sum.up_to_own - here;
        for (var at = own; at < own + RUN; at++) {
            if at < number {
                let count = blocks[at];
                blocks[at] = place;
                place += count;
            }
        }
        before += sum.all;
    }
}

// How many candidates are kept before this one.
fn kept_before(entry: u32) -> u32 {
    let thread = min(entry, settings.entries - 1u) / RUN;
    let word = marks[thread];
    let earlier = (1u << (entry - thread * RUN)) - 1u;
    return blocks[thread / 64u] + (word >> 8u) + countOneBits(word & 255u & earlier);
}

// A thread every eight candidates, and a thread a batch.
@compute @workgroup_size(64)
fn gather(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let thread = (group.y * groups.x + group.x) * 64u + lane;
    if thread < settings.count {
        let batch = batches[thread];
        let instances = kept_before(batch.first + batch.count) - kept_before(batch.first);
        draws[thread] = Draw(batch.index_count, instances, batch.first_index, batch.base_vertex, batch.first);
    }
    let own = thread * RUN;
    if own >= settings.entries || (marks[thread] & 255u) == 0u {
        return;
    }
    let word = marks[thread] & 255u;
    var number = batch_at(own);
    var batch = batches[number];
    var place = batch.first + kept_before(own) - kept_before(batch.first);
    for (var at = 0u; at < min(RUN, settings.entries - own); at++) {
        if own + at >= batch.first + batch.count {
            number += 1u;
            batch = batches[number];
            place = batch.first;
        }
        if ((word >> at) & 1u) != 0u {
            kept[place] = candidates[own + at] & ~(FORCED | BARRED);
            place++;
        }
    }
}
