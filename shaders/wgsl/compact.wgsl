//!import threshold
// The on-gpu visible set: keeps those candidates of each batch whose visible samples are within its bounds, in order, and
// writes the batch's indirect draw. One workgroup a batch, so the order (and with it every tie) is the same each run.

struct Batch {
    first: u32,
    count: u32,
    index_count: u32,
    first_index: u32,
    base_vertex: i32,
    // An entity is kept with more visible samples than `over` and the threshold, and at most `most`.
    over: u32,
    most: u32,
    // Not 0: it is kept with none.
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
    // Batches.
    count: u32,
    // 0: a frame with a fixed threshold binds these words as its `AdaptedThreshold`.
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
}

// A candidate that was not tested is drawn: the high bit of its entry says so. The next one says that it is drawn from another batch.
const FORCED: u32 = 0x80000000u;
const BARRED: u32 = 0x40000000u;

@group(0) @binding(0) var<storage, read> settings: Settings;
@group(0) @binding(1) var<storage, read> batches: array<Batch>;
@group(0) @binding(2) var<storage, read> candidates: array<u32>;
@group(0) @binding(3) var<storage, read> counts: array<u32>;
@group(0) @binding(4) var<storage, read_write> kept: array<u32>;
@group(0) @binding(5) var<storage, read_write> draws: array<Draw>;
@group(0) @binding(6) var<storage, read> adapted: AdaptedThreshold;

var<workgroup> sums: array<u32, 64>;

@compute @workgroup_size(64)
fn compact(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let index = group.y * groups.x + group.x;
    if index >= settings.count {
        return;
    }
    let batch = batches[index];
    var written = 0u;
    for (var start = 0u; start < batch.count; start += 64u) {
        let at = start + lane;
        var keep = 0u;
        var slot = 0u;
        if at < batch.count {
            let entry = candidates[batch.first + at];
            slot = entry & ~(FORCED | BARRED);
            let samples = counts[slot];
            let within = select(samples > max(batch.over, adapted.threshold) && samples <= batch.most, samples == 0u, batch.hidden != 0u);
            keep = select(0u, 1u, (entry & FORCED) != 0u || (within && (entry & BARRED) == 0u));
        }
        // Inclusive prefix sum over the workgroup (Hillis and Steele, Data Parallel Algorithms, 1986).
        sums[lane] = keep;
        workgroupBarrier();
        for (var stride = 1u; stride < 64u; stride *= 2u) {
            var other = 0u;
            if lane >= stride {
                other = sums[lane - stride];
            }
            workgroupBarrier();
            sums[lane] += other;
            workgroupBarrier();
        }
        if keep != 0u {
            kept[batch.first + written + sums[lane] - 1u] = slot;
        }
        written += sums[63];
        workgroupBarrier();
    }
    if lane == 0u {
        draws[index] = Draw(batch.index_count, written, batch.first_index, batch.base_vertex, batch.first);
    }
}
