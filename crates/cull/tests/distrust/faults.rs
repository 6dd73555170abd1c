//! Injected faults: the shader of a job is replaced by one that does what wrong drivers do.

use antumbra_cull::{Capability, Gpu};

/// A fault.
#[derive(Clone, Copy)]
pub struct Fault {
    /// What the driver does.
    pub name: &'static str,
    change: fn(&str, &str) -> Option<String>,
    /// What the self-test finds wrong.
    pub breaks: &'static [Capability],
}

impl Fault {
    /// A device with this fault.
    pub fn on(&self, gpu: &Gpu) -> Gpu {
        gpu.with_changed_shaders(self.change)
    }
}

/// A shader with one text in place of another, which it must have.
fn with(source: &str, old: &str, new: &str) -> Option<String> {
    assert!(source.contains(old), "no `{old}` in the shader");
    Some(source.replace(old, new))
}

/// Counts of every fourth entity are lost.
pub const LOST_COUNT: Fault = Fault {
    name: "a lost write of counts by atomics",
    change: |name, source| match name {
        "count_atomic" => with(
            source,
            "atomicAdd(&counts[in.slot],",
            "atomicAdd(&counts[select(in.slot, 0u, in.slot % 4u == 1u)],",
        ),
        _ => None,
    },
    breaks: &[Capability::FragmentAtomics],
};

/// Both ways in which fragments count themselves lose counts.
pub const LOST_COUNTS: Fault = Fault {
    name: "lost writes of fragments",
    change: |name, source| match name {
        "count_atomic" | "count_compare" => with(
            source,
            "atomicAdd(&counts[in.slot],",
            "atomicAdd(&counts[select(in.slot, 0u, in.slot % 4u == 1u)],",
        ),
        _ => None,
    },
    breaks: &[Capability::FragmentAtomics, Capability::FragmentCompare],
};

/// The histogram loses what every fourth entity owns.
pub const LOST_HISTOGRAM: Fault = Fault {
    name: "a lost write of the histogram",
    change: |name, source| match name {
        "histogram_one" | "histogram_many" => with(
            source,
            "atomicAdd(&counts[current - 1u], length)",
            "atomicAdd(&counts[current - 1u], select(length, 0u, current % 4u == 2u))",
        ),
        _ => None,
    },
    breaks: &[Capability::IdHistogram],
};

/// What a box test finds of every fifth entity is lost.
pub const LOST_FIND: Fault = Fault {
    name: "a lost write of the box test",
    change: |name, source| match name {
        "test_slots_one" | "test_slots_many" => with(
            source,
            "let state = state_of(slot, lane, is_tested);",
            "let state = select(state_of(slot, lane, is_tested), SLOT_HIDDEN, slot % 5u == 3u);",
        ),
        _ => None,
    },
    breaks: &[Capability::BoxTest],
};

/// The last part of every mesh is not looked at.
pub const LOST_PART: Fault = Fault {
    name: "a part that is left out",
    change: |name, source| match name {
        "test_slots_one" | "test_slots_many" => with(
            source,
            "if number < parts_from(first) && look_once(",
            "if number + 1u < parts_from(first) && look_once(",
        ),
        _ => None,
    },
    breaks: &[Capability::BoxTest],
};

/// A level of the pyramid keeps what it first held.
pub const STALE_LEVEL: Fault = Fault {
    name: "a stale level",
    change: |name, source| match name {
        "pyramid_one" | "pyramid_many" => with(
            source,
            "if level < pyramid.count && all(at < place.yz) {",
            "if level < pyramid.count && all(at < place.yz) && (level != 3u || texels[place.x + at.y * place.y + at.x] == 0.0) {",
        ),
        _ => None,
    },
    breaks: &[Capability::DepthPyramid],
};

/// A level of the pyramid lies a texel beside its place.
pub const SHIFTED_LEVEL: Fault = Fault {
    name: "a level shifted by one",
    change: |name, source| match name {
        "pyramid_one" | "pyramid_many" => with(
            source,
            "texels[place.x + at.y * place.y + at.x] = value;",
            "texels[place.x + at.y * place.y + at.x + select(0u, 1u, level == 2u)] = value;",
        ),
        _ => None,
    },
    breaks: &[Capability::DepthPyramid],
};

/// The box test reads the level before the one that it asks for.
pub const OTHER_LEVEL: Fault = Fault {
    name: "another level than the one that is asked for",
    change: |name, source| match name {
        "test_slots_one" | "test_slots_many" => with(
            source,
            "let row = pyramid.levels[level];",
            "let row = pyramid.levels[max(level, 3u) - 1u];",
        ),
        _ => None,
    },
    breaks: &[Capability::BoxTest],
};

/// Queries around boxes are zero, every fourth of them.
pub const ZEROED_BOX_QUERY: Fault = Fault {
    name: "a zeroed query around a box",
    change: |name, source| match name {
        "boxes" => {
            let numbered = with(
                source,
                "@builtin(vertex_index) corner: u32,",
                "@builtin(vertex_index) corner: u32, @builtin(instance_index) number: u32,",
            )?;
            with(
                &numbered,
                "    let far = (FAR_ENDS",
                "    if number % 4u == 1u { return vec4<f32>(2.0, 2.0, 0.5, 1.0); }\n    let far = (FAR_ENDS",
            )
        }
        _ => None,
    },
    breaks: &[Capability::OcclusionQueries],
};

/// Depth passes and queries leave out every fourth mesh: such queries are zero.
pub const ZEROED_MESH_QUERY: Fault = Fault {
    name: "a zeroed query around a mesh",
    change: |name, source| match name {
        "depth" => with(
            source,
            "    return clip_position(",
            "    if slot % 4u == 1u { return vec4<f32>(2.0, 2.0, 0.5, 1.0); }\n    return clip_position(",
        ),
        _ => None,
    },
    breaks: &[
        Capability::FragmentAtomics,
        Capability::FragmentCompare,
        Capability::OcclusionQueries,
        Capability::DepthPyramid,
    ],
};

/// A compaction loses a slot of each list.
pub const LOST_SLOT: Fault = Fault {
    name: "a lost write of the compaction",
    change: |name, source| match name {
        "compact" => with(
            source,
            "kept[place] =",
            "kept[select(place, place + 1u, place == batch.first + 3u)] =",
        ),
        _ => None,
    },
    breaks: &[Capability::Compaction],
};

/// An indirect draw has no instances.
pub const LOST_DRAW: Fault = Fault {
    name: "a draw left out",
    change: |name, source| match name {
        "compact" => with(
            source,
            "batch.index_count, instances,",
            "batch.index_count, 0u,",
        ),
        _ => None,
    },
    breaks: &[Capability::Compaction],
};

/// An instance is not drawn, whatever draws it.
pub const LOST_INSTANCE: Fault = Fault {
    name: "an instance left out",
    change: |name, source| match name {
        "identity" => with(
            source,
            "    out.clip = clip_position(relative_position(instances[slot], local));",
            "    out.clip = clip_position(relative_position(instances[slot], local));\n    if slot == 7u { out.clip = vec4<f32>(2.0, 2.0, 0.5, 1.0); }",
        ),
        _ => None,
    },
    breaks: &[Capability::IdHistogram, Capability::IndirectFirstInstance],
};

/// A compiler joins the halves of coordinates before it subtracts the eye.
pub const REORDERED: Fault = Fault {
    name: "reordered positions",
    change: |_, source| {
        let halves = "bitcast<vec3<f32>>(far) + bitcast<vec3<f32>>(near)";
        let joined = "(high + low) - (view.eye_high + view.eye_low)";
        source
            .contains(halves)
            .then(|| source.replace(halves, joined))
    },
    breaks: &[
        Capability::FragmentAtomics,
        Capability::FragmentCompare,
        Capability::IdHistogram,
        Capability::OcclusionQueries,
        Capability::DepthPyramid,
        Capability::IndirectFirstInstance,
    ],
};

/// All of them.
pub const ALL: [Fault; 14] = [
    REORDERED,
    LOST_COUNT,
    LOST_COUNTS,
    LOST_HISTOGRAM,
    LOST_FIND,
    LOST_PART,
    STALE_LEVEL,
    SHIFTED_LEVEL,
    OTHER_LEVEL,
    ZEROED_BOX_QUERY,
    ZEROED_MESH_QUERY,
    LOST_SLOT,
    LOST_DRAW,
    LOST_INSTANCE,
];
