// The inclusive prefix sum over a workgroup of 64 threads (Hillis and Steele, Data Parallel Algorithms, 1986).

var<workgroup> sums: array<u32, 64>;

struct PrefixSum {
    // The sum of the numbers of this thread and of those before it.
    up_to_own: u32,
    // The sum of all numbers.
    all: u32,
}

// All threads of the workgroup must call it.
fn prefix_sum(lane: u32, number: u32) -> PrefixSum {
    sums[lane] = number;
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
    let found = PrefixSum(sums[lane], sums[63]);
    // The next call may write.
    workgroupBarrier();
    return found;
}
