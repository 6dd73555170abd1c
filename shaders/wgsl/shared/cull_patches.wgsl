//!import marks
//!import threshold
// Culls entries of image patches: keeps an entry unless its bounding box is behind the finished depth in each pixel that the box covers.
// Writes the kept entries and the instance counts of the indirect draws.
// (Testing boxes against depth before drawing meshes: Greene, Kass, Miller, Hierarchical Z-Buffer Visibility, 1993. Here the box is tested
// against each pixel, since a patch has few.)

struct Settings {
    // Number of entries.
    count: u32,
    // Where the GPU chooses the visible set: entities with more visible samples than this are drawn already, so they are skipped. A frame with a
    // fixed threshold binds these words as its `AdaptedThreshold`.
    threshold: u32,
    padding_a: u32,
    // Samples a pixel.
    samples: u32,
}

// An entity in a patch: the reversed depth of its box's nearest point, and the pixels of the patch that the box covers, both ends included; x in
// the low half, y in the high half.
struct Entry {
    slot: u32,
    patch_number: u32,
    draw: u32,
    nearest: f32,
    least: u32,
    greatest: u32,
}

struct Draw {
    index_count: u32,
    instance_count: atomic<u32>,
    first_index: u32,
    base_vertex: i32,
    first_instance: u32,
}

@group(0) @binding(0) var<storage, read> settings: Settings;
@group(0) @binding(1) var<storage, read> entries: array<Entry>;
// Visible samples by slot. A short buffer where the host has left out the drawn entities already.
@group(0) @binding(2) var<storage, read> counts: array<u32>;
// Slot, and patch number with `patch_parity`, of each kept entry, at its draw's instances.
@group(0) @binding(4) var<storage, read_write> kept: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read_write> draws: array<Draw>;
// Words a patch, see `shared/marks.wgsl`; the last word of the buffer takes the visible samples that an adapted threshold leaves out.
@group(0) @binding(6) var<storage, read_write> shown: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read> adapted: AdaptedThreshold;

fn may_show(entry: Entry) -> bool {
    let least = vec2<u32>(entry.least & 0xffffu, entry.least >> 16u);
    let greatest = vec2<u32>(entry.greatest & 0xffffu, entry.greatest >> 16u);
    for (var y = least.y; y <= greatest.y; y++) {
        for (var x = least.x; x <= greatest.x; x++) {
            // Reversed depth: greater or equal is at or in front of what was drawn.
            if entry.nearest >= farthest(vec2<u32>(x, y)) {
                return true;
            }
        }
    }
    return false;
}

@compute @workgroup_size(64)
fn cull_patches(@builtin(global_invocation_id) at: vec3<u32>) {
    if at.x == 0u {
        atomicStore(&shown[arrayLength(&shown) - 1u], adapted.left_out);
    }
    if at.x >= settings.count {
        return;
    }
    let entry = entries[at.x];
    if entry.slot < arrayLength(&counts) && counts[entry.slot] > adapted.threshold {
        return;
    }
    if !may_show(entry) {
        return;
    }
    // The order of kept entries varies from run to run; the marks do not depend on it.
    let corner = vec2<u32>(entry.least & 0xffffu, entry.least >> 16u);
    let place = atomicAdd(&draws[entry.draw].instance_count, 1u);
    kept[draws[entry.draw].first_instance + place] = vec2<u32>(entry.slot, entry.patch_number | patch_parity(corner));
    atomicAdd(&shown[entry.patch_number * WORDS + MARK_WORDS], draws[entry.draw].index_count);
}
