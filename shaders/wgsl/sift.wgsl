//!import marks
//!import turned
// Of what may show in a few patches of the image, keeps what the finished depth does not hide already by its box, and writes the indirect draws.
// (Boxes against depth before meshes: Greene, Kass, Miller, Hierarchical Z-Buffer Visibility, 1993; here against each pixel, for they are few.)

struct Settings {
    // Entries.
    count: u32,
    // Where entities are chosen on the GPU: those with more visible samples than this are drawn already. These words stand in for a threshold that is
    // not turned.
    threshold: u32,
    padding_a: u32,
    padding_b: u32,
}

// An entity in a patch: as near as its box comes, and the pixels of the patch that the box covers, both ends included; x low, y high.
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
// Visible samples by slot; one word alone where the host has left out what is drawn.
@group(0) @binding(2) var<storage, read> counts: array<u32>;
// A plain float texture, not a depth one: GL cannot load from depth textures.
@group(0) @binding(3) var finished_depth: texture_2d<f32>;
@group(0) @binding(4) var<storage, read_write> kept: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read_write> draws: array<Draw>;
// Patch by patch, and in the last word the visible samples of all that a turned threshold left out.
@group(0) @binding(6) var<storage, read_write> shown: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read> turned: Turned;

fn may_show(entry: Entry) -> bool {
    let least = vec2<u32>(entry.least & 0xffffu, entry.least >> 16u);
    let greatest = vec2<u32>(entry.greatest & 0xffffu, entry.greatest >> 16u);
    for (var y = least.y; y <= greatest.y; y++) {
        for (var x = least.x; x <= greatest.x; x++) {
            // Reversed depth: at or in front of what was drawn means greater or equal.
            if entry.nearest >= textureLoad(finished_depth, vec2<u32>(x, y), 0).x {
                return true;
            }
        }
    }
    return false;
}

@compute @workgroup_size(64)
fn sift(@builtin(global_invocation_id) at: vec3<u32>) {
    if at.x == 0u {
        atomicStore(&shown[arrayLength(&shown) - 1u], turned.left_out);
    }
    if at.x >= settings.count {
        return;
    }
    let entry = entries[at.x];
    if entry.slot < arrayLength(&counts) && counts[entry.slot] > turned.threshold {
        return;
    }
    if !may_show(entry) {
        return;
    }
    // In any order: a mark is the same whoever leaves it first.
    let place = atomicAdd(&draws[entry.draw].instance_count, 1u);
    kept[draws[entry.draw].first_instance + place] = vec2<u32>(entry.slot, entry.patch_number);
    atomicAdd(&shown[entry.patch_number * WORDS + MARK_WORDS], draws[entry.draw].index_count);
}
