//!import prefix_sum
// Writes the indirect draws of a host: of each draw's members, those whose bit is set are kept, in order, and counted.

struct DrawTemplate {
    // The first word of the draw, indices or vertices.
    elements: u32,
    // The words after the instance count. The last of a draw is replaced by `first_member`.
    first_element: u32,
    base_vertex: u32,
    first_member: u32,
    members: u32,
}

struct Settings {
    // Number of draws.
    count: u32,
    // Words of a draw: 5 indexed, 4 otherwise.
    words: u32,
    padding_a: u32,
    padding_b: u32,
}

@group(0) @binding(0) var<storage, read> settings: Settings;
@group(0) @binding(1) var<storage, read> templates: array<DrawTemplate>;
@group(0) @binding(2) var<storage, read> members: array<u32>;
@group(0) @binding(3) var<storage, read> chosen: array<u32>;
@group(0) @binding(4) var<storage, read_write> draws: array<u32>;
@group(0) @binding(5) var<storage, read_write> kept: array<u32>;

fn is_chosen(index: u32) -> u32 {
    // A member that does not exist is not drawn.
    if index / 32u >= arrayLength(&chosen) {
        return 0u;
    }
    return (chosen[index / 32u] >> (index % 32u)) & 1u;
}

fn write(number: u32, instances: u32) {
    let draw = templates[number];
    let at = number * settings.words;
    draws[at] = draw.elements;
    draws[at + 1u] = instances;
    draws[at + 2u] = draw.first_element;
    if settings.words == 5u {
        draws[at + 3u] = draw.base_vertex;
    }
    draws[at + settings.words - 1u] = draw.first_member;
}

// A thread a draw: for draws of few members.
@compute @workgroup_size(64)
fn few(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * groups.x + group.x) * 64u + lane;
    if number >= settings.count {
        return;
    }
    let draw = templates[number];
    var written = 0u;
    for (var at = 0u; at < draw.members; at++) {
        let index = members[draw.first_member + at];
        if is_chosen(index) != 0u {
            kept[draw.first_member + written] = index;
            written++;
        }
    }
    write(number, written);
}

// Members in a row that one thread looks at, so that a prefix sum is for so many more of them.
const RUN: u32 = 8u;

// A workgroup a draw: for draws of many members.
@compute @workgroup_size(64)
fn many(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let number = group.y * groups.x + group.x;
    if number >= settings.count {
        return;
    }
    let draw = templates[number];
    var written = 0u;
    for (var start = 0u; start < draw.members; start += 64u * RUN) {
        let own = start + lane * RUN;
        var keep = 0u;
        for (var at = 0u; at < RUN; at++) {
            if own + at < draw.members {
                keep |= is_chosen(members[draw.first_member + own + at]) << at;
            }
        }
        let sum = prefix_sum(lane, countOneBits(keep));
        var place = draw.first_member + written + sum.up_to_own - countOneBits(keep);
        for (var at = 0u; at < RUN; at++) {
            if ((keep >> at) & 1u) != 0u {
                kept[place] = members[draw.first_member + own + at];
                place++;
            }
        }
        written += sum.all;
    }
    if lane == 0u {
        write(number, written);
    }
}
