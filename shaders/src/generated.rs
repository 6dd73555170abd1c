// Written by `make shaders` from `wgsl/`; a test fails where the two differ. Do not edit.

/// Every built-in job, by name.
pub static ALL: &[&crate::Job] = &[
&adapt_threshold::JOB,
&boxes::JOB,
&compact::JOB,
&count_atomic::JOB,
&count_compare::JOB,
&count_compare_many::JOB,
&cull_patches_many::JOB,
&cull_patches_one::JOB,
&depth::JOB,
&first_slots::JOB,
&histogram_many::JOB,
&histogram_one::JOB,
&identity::JOB,
&judge_draws::JOB,
&judge_first::JOB,
&judge_many::JOB,
&judge_one::JOB,
&max_counts::JOB,
&patch_compare::JOB,
&patch_compare_many::JOB,
&patch_early::JOB,
&pyramid_many::JOB,
&pyramid_one::JOB,
&pyramid_rest::JOB,
&recall_slots::JOB,
&retest_slots_many::JOB,
&retest_slots_one::JOB,
&rival_bevy::JOB,
&rival_bevy_meshlets::JOB,
&rival_helio::JOB,
&rival_niagara::JOB,
&rival_pyramid_many::JOB,
&rival_pyramid_one::JOB,
&rival_pyramid_rest::JOB,
&rival_unity::JOB,
&rival_vk_lod_clusters::JOB,
&sample_identity::JOB,
&scatter::JOB,
&scatter_records::JOB,
&shaded::JOB,
&signature::JOB,
&signature_early::JOB,
&signature_many::JOB,
&test_slots_many::JOB,
&test_slots_one::JOB,
];
/// The shared texts for `//!import`, by name.
pub static SHARED: &[crate::SharedSource<'static>] = &[
crate::SharedSource { name: "box_test", text: include_str!("../wgsl/shared/box_test.wgsl") },
crate::SharedSource { name: "clip", text: include_str!("../wgsl/shared/clip.wgsl") },
crate::SharedSource { name: "counted", text: include_str!("../wgsl/shared/counted.wgsl") },
crate::SharedSource { name: "cull_patches", text: include_str!("../wgsl/shared/cull_patches.wgsl") },
crate::SharedSource { name: "depth_many", text: include_str!("../wgsl/shared/depth_many.wgsl") },
crate::SharedSource { name: "depth_one", text: include_str!("../wgsl/shared/depth_one.wgsl") },
crate::SharedSource { name: "environment", text: include_str!("../wgsl/shared/environment.wgsl") },
crate::SharedSource { name: "eye_relative", text: include_str!("../wgsl/shared/eye_relative.wgsl") },
crate::SharedSource { name: "histogram", text: include_str!("../wgsl/shared/histogram.wgsl") },
crate::SharedSource { name: "identified", text: include_str!("../wgsl/shared/identified.wgsl") },
crate::SharedSource { name: "instance", text: include_str!("../wgsl/shared/instance.wgsl") },
crate::SharedSource { name: "judge", text: include_str!("../wgsl/shared/judge.wgsl") },
crate::SharedSource { name: "judged", text: include_str!("../wgsl/shared/judged.wgsl") },
crate::SharedSource { name: "judged_instance", text: include_str!("../wgsl/shared/judged_instance.wgsl") },
crate::SharedSource { name: "light", text: include_str!("../wgsl/shared/light.wgsl") },
crate::SharedSource { name: "look_at_parts", text: include_str!("../wgsl/shared/look_at_parts.wgsl") },
crate::SharedSource { name: "look_together", text: include_str!("../wgsl/shared/look_together.wgsl") },
crate::SharedSource { name: "marks", text: include_str!("../wgsl/shared/marks.wgsl") },
crate::SharedSource { name: "material", text: include_str!("../wgsl/shared/material.wgsl") },
crate::SharedSource { name: "packed_id", text: include_str!("../wgsl/shared/packed_id.wgsl") },
crate::SharedSource { name: "part_box", text: include_str!("../wgsl/shared/part_box.wgsl") },
crate::SharedSource { name: "patch", text: include_str!("../wgsl/shared/patch.wgsl") },
crate::SharedSource { name: "position", text: include_str!("../wgsl/shared/position.wgsl") },
crate::SharedSource { name: "prefix_sum", text: include_str!("../wgsl/shared/prefix_sum.wgsl") },
crate::SharedSource { name: "pyramid", text: include_str!("../wgsl/shared/pyramid.wgsl") },
crate::SharedSource { name: "reduce", text: include_str!("../wgsl/shared/reduce.wgsl") },
crate::SharedSource { name: "relative_box", text: include_str!("../wgsl/shared/relative_box.wgsl") },
crate::SharedSource { name: "retest_slots", text: include_str!("../wgsl/shared/retest_slots.wgsl") },
crate::SharedSource { name: "rival", text: include_str!("../wgsl/shared/rival.wgsl") },
crate::SharedSource { name: "rival_pyramid", text: include_str!("../wgsl/shared/rival_pyramid.wgsl") },
crate::SharedSource { name: "rival_slots", text: include_str!("../wgsl/shared/rival_slots.wgsl") },
crate::SharedSource { name: "screen_size", text: include_str!("../wgsl/shared/screen_size.wgsl") },
crate::SharedSource { name: "seen_shape", text: include_str!("../wgsl/shared/seen_shape.wgsl") },
crate::SharedSource { name: "slot_state_of", text: include_str!("../wgsl/shared/slot_state_of.wgsl") },
crate::SharedSource { name: "slot_states", text: include_str!("../wgsl/shared/slot_states.wgsl") },
crate::SharedSource { name: "test_slots", text: include_str!("../wgsl/shared/test_slots.wgsl") },
crate::SharedSource { name: "threshold", text: include_str!("../wgsl/shared/threshold.wgsl") },
crate::SharedSource { name: "transparent_sums", text: include_str!("../wgsl/shared/transparent_sums.wgsl") },
crate::SharedSource { name: "view", text: include_str!("../wgsl/shared/view.wgsl") },
];
/// `wgsl/adapt_threshold.wgsl`.
pub mod adapt_threshold {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/adapt_threshold.wgsl"), include_str!("../wgsl/shared/threshold.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("adapt_threshold"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/adapt_threshold.wgsl"), first_line: 1, lines: 100 }, crate::SourcePart { file: Borrowed("wgsl/shared/threshold.wgsl"), first_line: 101, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("adapt_threshold"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("settings"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(16) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("adapt_threshold"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("judged"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("adapt_threshold"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("counts"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("adapt_threshold"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("adapted"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(16) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("adapt_threshold"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("AdaptedThreshold"), kind: crate::LayoutKind::Memory, size: 16, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("padding_a"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("threshold"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("left_out"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 12, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Settings"), kind: crate::LayoutKind::Memory, size: 16, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("count"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("allowed"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("least"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("padding"), offset: 12, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `adapt_threshold`.
pub const ADAPT_THRESHOLD: &str = "adapt_threshold";
}
/// Places of the variables in use.
pub mod binding {
/// `settings`.
pub const SETTINGS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `judged`.
pub const JUDGED: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `counts`.
pub const COUNTS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `adapted`.
pub const ADAPTED: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `adapt_threshold`.
pub const ADAPT_THRESHOLD: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/boxes.wgsl`.
pub mod boxes {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/boxes.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("boxes"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/boxes.wgsl"), first_line: 1, lines: 19 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 20, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 34, lines: 11 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("centre"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("x"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 2, name: Borrowed("y"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 3, name: Borrowed("z"), format: wgpu::VertexFormat::Float32x3 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty(), };
/// Names of the entry points.
pub mod entry {
/// `vertex`.
pub const VERTEX: &str = "vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/compact.wgsl`.
pub mod compact {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/compact.wgsl"), include_str!("../wgsl/shared/threshold.wgsl"), include_str!("../wgsl/shared/prefix_sum.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("compact"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/compact.wgsl"), first_line: 1, lines: 167 }, crate::SourcePart { file: Borrowed("wgsl/shared/threshold.wgsl"), first_line: 168, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/prefix_sum.wgsl"), first_line: 178, lines: 29 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("mark"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("scan"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("gather"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("settings"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(16) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("mark"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("scan"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("gather"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("batches"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(32) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("mark"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("gather"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("candidates"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("mark"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("gather"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("counts"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("mark"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("kept"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("gather"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("draws"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(20) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("gather"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("adapted"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(16) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("mark"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("marks"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("mark"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("gather"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("blocks"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("mark"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("scan"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("gather"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("AdaptedThreshold"), kind: crate::LayoutKind::Memory, size: 16, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("padding_a"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("threshold"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("left_out"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 12, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Batch"), kind: crate::LayoutKind::Memory, size: 32, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("first"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("index_count"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("first_index"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("base_vertex"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("over"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("most"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("hidden"), offset: 28, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Draw"), kind: crate::LayoutKind::Memory, size: 20, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("index_count"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("instance_count"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("first_index"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("base_vertex"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("first_instance"), offset: 16, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Settings"), kind: crate::LayoutKind::Memory, size: 16, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("count"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("entries"), offset: 12, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `mark`.
pub const MARK: &str = "mark";
/// `scan`.
pub const SCAN: &str = "scan";
/// `gather`.
pub const GATHER: &str = "gather";
}
/// Places of the variables in use.
pub mod binding {
/// `settings`.
pub const SETTINGS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `batches`.
pub const BATCHES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `candidates`.
pub const CANDIDATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `counts`.
pub const COUNTS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `kept`.
pub const KEPT: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `draws`.
pub const DRAWS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `adapted`.
pub const ADAPTED: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `marks`.
pub const MARKS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
/// `blocks`.
pub const BLOCKS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `mark`.
pub const MARK: [u32; 3] = [64, 1, 1];
/// Of `scan`.
pub const SCAN: [u32; 3] = [64, 1, 1];
/// Of `gather`.
pub const GATHER: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/count_atomic.wgsl`.
pub mod count_atomic {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/count_atomic.wgsl"), include_str!("../wgsl/shared/counted.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("count_atomic"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/count_atomic.wgsl"), first_line: 1, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/counted.wgsl"), first_line: 15, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 33, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 49, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 63, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 74, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 86, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: true, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: true, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("counts"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty().union(wgpu::Features::SHADER_EARLY_DEPTH_TEST), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE).union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE).union(wgpu::DownlevelFlags::MULTISAMPLED_SHADING), };
/// Names of the entry points.
pub mod entry {
/// `fragment`.
pub const FRAGMENT: &str = "fragment";
/// `fragment_of_samples`.
pub const FRAGMENT_OF_SAMPLES: &str = "fragment_of_samples";
/// `vertex`.
pub const VERTEX: &str = "vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `counts`.
pub const COUNTS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/count_compare.wgsl`.
pub mod count_compare {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/count_compare.wgsl"), include_str!("../wgsl/shared/counted.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("count_compare"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/count_compare.wgsl"), first_line: 1, lines: 13 }, crate::SourcePart { file: Borrowed("wgsl/shared/counted.wgsl"), first_line: 14, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 32, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 48, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 62, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 73, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 85, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("counts"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("occluder_depth"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE).union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE), };
/// Names of the entry points.
pub mod entry {
/// `fragment`.
pub const FRAGMENT: &str = "fragment";
/// `vertex`.
pub const VERTEX: &str = "vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `counts`.
pub const COUNTS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `occluder_depth`.
pub const OCCLUDER_DEPTH: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/count_compare_many.wgsl`.
pub mod count_compare_many {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/count_compare_many.wgsl"), include_str!("../wgsl/shared/counted.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("count_compare_many"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/count_compare_many.wgsl"), first_line: 1, lines: 13 }, crate::SourcePart { file: Borrowed("wgsl/shared/counted.wgsl"), first_line: 14, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 32, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 48, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 62, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 73, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 85, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("counts"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("occluder_depth"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: true }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE).union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE).union(wgpu::DownlevelFlags::MULTISAMPLED_SHADING), };
/// Names of the entry points.
pub mod entry {
/// `fragment_of_samples`.
pub const FRAGMENT_OF_SAMPLES: &str = "fragment_of_samples";
/// `vertex`.
pub const VERTEX: &str = "vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `counts`.
pub const COUNTS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `occluder_depth`.
pub const OCCLUDER_DEPTH: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/cull_patches_many.wgsl`.
pub mod cull_patches_many {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/cull_patches_many.wgsl"), include_str!("../wgsl/shared/cull_patches.wgsl"), include_str!("../wgsl/shared/marks.wgsl"), include_str!("../wgsl/shared/threshold.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("cull_patches_many"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/cull_patches_many.wgsl"), first_line: 1, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/cull_patches.wgsl"), first_line: 13, lines: 83 }, crate::SourcePart { file: Borrowed("wgsl/shared/marks.wgsl"), first_line: 96, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/threshold.wgsl"), first_line: 112, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("settings"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(16) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("entries"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(24) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("counts"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("finished_depth"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: true }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("kept"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(8) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("draws"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(20) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("shown"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("adapted"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(16) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("AdaptedThreshold"), kind: crate::LayoutKind::Memory, size: 16, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("padding_a"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("threshold"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("left_out"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 12, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Draw"), kind: crate::LayoutKind::Memory, size: 20, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("index_count"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("instance_count"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("first_index"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("base_vertex"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("first_instance"), offset: 16, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Entry"), kind: crate::LayoutKind::Memory, size: 24, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("slot"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("patch_number"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("draw"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("nearest"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("least"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("greatest"), offset: 20, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Settings"), kind: crate::LayoutKind::Memory, size: 16, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("count"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("threshold"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 12, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `cull_patches`.
pub const CULL_PATCHES: &str = "cull_patches";
}
/// Places of the variables in use.
pub mod binding {
/// `settings`.
pub const SETTINGS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `entries`.
pub const ENTRIES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `counts`.
pub const COUNTS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `finished_depth`.
pub const FINISHED_DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `kept`.
pub const KEPT: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `draws`.
pub const DRAWS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `shown`.
pub const SHOWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `adapted`.
pub const ADAPTED: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `cull_patches`.
pub const CULL_PATCHES: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/cull_patches_one.wgsl`.
pub mod cull_patches_one {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/cull_patches_one.wgsl"), include_str!("../wgsl/shared/cull_patches.wgsl"), include_str!("../wgsl/shared/marks.wgsl"), include_str!("../wgsl/shared/threshold.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("cull_patches_one"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/cull_patches_one.wgsl"), first_line: 1, lines: 9 }, crate::SourcePart { file: Borrowed("wgsl/shared/cull_patches.wgsl"), first_line: 10, lines: 83 }, crate::SourcePart { file: Borrowed("wgsl/shared/marks.wgsl"), first_line: 93, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/threshold.wgsl"), first_line: 109, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("settings"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(16) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("entries"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(24) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("counts"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("finished_depth"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("kept"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(8) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("draws"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(20) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("shown"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("adapted"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(16) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("cull_patches"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("AdaptedThreshold"), kind: crate::LayoutKind::Memory, size: 16, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("padding_a"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("threshold"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("left_out"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 12, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Draw"), kind: crate::LayoutKind::Memory, size: 20, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("index_count"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("instance_count"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("first_index"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("base_vertex"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("first_instance"), offset: 16, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Entry"), kind: crate::LayoutKind::Memory, size: 24, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("slot"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("patch_number"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("draw"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("nearest"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("least"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("greatest"), offset: 20, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Settings"), kind: crate::LayoutKind::Memory, size: 16, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("count"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("threshold"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 12, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `cull_patches`.
pub const CULL_PATCHES: &str = "cull_patches";
}
/// Places of the variables in use.
pub mod binding {
/// `settings`.
pub const SETTINGS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `entries`.
pub const ENTRIES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `counts`.
pub const COUNTS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `finished_depth`.
pub const FINISHED_DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `kept`.
pub const KEPT: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `draws`.
pub const DRAWS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `shown`.
pub const SHOWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `adapted`.
pub const ADAPTED: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `cull_patches`.
pub const CULL_PATCHES: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/depth.wgsl`.
pub mod depth {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/depth.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("depth"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/depth.wgsl"), first_line: 1, lines: 7 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 8, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 24, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 38, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 49, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 61, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::VERTEX_STORAGE), };
/// Names of the entry points.
pub mod entry {
/// `vertex`.
pub const VERTEX: &str = "vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/first_slots.wgsl`.
pub mod first_slots {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/first_slots.wgsl"), include_str!("../wgsl/shared/screen_size.wgsl"), include_str!("../wgsl/shared/judged.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/slot_states.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("first_slots"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/first_slots.wgsl"), first_line: 1, lines: 47 }, crate::SourcePart { file: Borrowed("wgsl/shared/screen_size.wgsl"), first_line: 48, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged.wgsl"), first_line: 59, lines: 126 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 185, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 203, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 231, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_states.wgsl"), first_line: 243, lines: 6 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("first_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(128) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("states"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("first"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("JudgedView"), kind: crate::LayoutKind::Memory, size: 128, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 96, size: 4 }, crate::FieldLayout { name: Borrowed("depth_step"), offset: 100, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 104, size: 4 }, crate::FieldLayout { name: Borrowed("flags"), offset: 108, size: 4 }, crate::FieldLayout { name: Borrowed("shift"), offset: 112, size: 4 }, crate::FieldLayout { name: Borrowed("drift_x"), offset: 116, size: 4 }, crate::FieldLayout { name: Borrowed("drift_y"), offset: 120, size: 4 }, crate::FieldLayout { name: Borrowed("drift_w"), offset: 124, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `first_slots`.
pub const FIRST_SLOTS: &str = "first_slots";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `states`.
pub const STATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `first`.
pub const FIRST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `first_slots`.
pub const FIRST_SLOTS: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/histogram_many.wgsl`.
pub mod histogram_many {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/histogram_many.wgsl"), include_str!("../wgsl/shared/histogram.wgsl"), include_str!("../wgsl/shared/packed_id.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("histogram_many"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/histogram_many.wgsl"), first_line: 1, lines: 8 }, crate::SourcePart { file: Borrowed("wgsl/shared/histogram.wgsl"), first_line: 9, lines: 38 }, crate::SourcePart { file: Borrowed("wgsl/shared/packed_id.wgsl"), first_line: 47, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("count"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("ids"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Uint, view_dimension: wgpu::TextureViewDimension::D2, multisampled: true }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("count"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("counts"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("count"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `count`.
pub const COUNT: &str = "count";
}
/// Places of the variables in use.
pub mod binding {
/// `ids`.
pub const IDS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `counts`.
pub const COUNTS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `count`.
pub const COUNT: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/histogram_one.wgsl`.
pub mod histogram_one {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/histogram_one.wgsl"), include_str!("../wgsl/shared/histogram.wgsl"), include_str!("../wgsl/shared/packed_id.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("histogram_one"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/histogram_one.wgsl"), first_line: 1, lines: 8 }, crate::SourcePart { file: Borrowed("wgsl/shared/histogram.wgsl"), first_line: 9, lines: 38 }, crate::SourcePart { file: Borrowed("wgsl/shared/packed_id.wgsl"), first_line: 47, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("count"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("ids"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Uint, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("count"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("counts"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("count"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `count`.
pub const COUNT: &str = "count";
}
/// Places of the variables in use.
pub mod binding {
/// `ids`.
pub const IDS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `counts`.
pub const COUNTS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `count`.
pub const COUNT: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/identity.wgsl`.
pub mod identity {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/identity.wgsl"), include_str!("../wgsl/shared/identified.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), include_str!("../wgsl/shared/material.wgsl"), include_str!("../wgsl/shared/packed_id.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("identity"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/identity.wgsl"), first_line: 1, lines: 17 }, crate::SourcePart { file: Borrowed("wgsl/shared/identified.wgsl"), first_line: 18, lines: 45 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 63, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 79, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 93, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 104, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 116, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/material.wgsl"), first_line: 126, lines: 43 }, crate::SourcePart { file: Borrowed("wgsl/shared/packed_id.wgsl"), first_line: 169, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("masked_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, ]),
}, crate::EntryPoint { name: Borrowed("masked_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 2, name: Borrowed("normal"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 3, name: Borrowed("uv"), format: wgpu::VertexFormat::Float32x2 }, crate::VertexInput { location: 4, name: Borrowed("colour"), format: wgpu::VertexFormat::Float32x4 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("masked_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("masked_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("masked_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("materials"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(80) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("masked_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("masked_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_texture"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: true }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("masked_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_sampler"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("masked_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Material"), kind: crate::LayoutKind::Memory, size: 80, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("base_colour"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("uv_u"), offset: 16, size: 12 }, crate::FieldLayout { name: Borrowed("alpha_cutoff"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("uv_v"), offset: 32, size: 12 }, crate::FieldLayout { name: Borrowed("unlit"), offset: 44, size: 4 }, crate::FieldLayout { name: Borrowed("metallic"), offset: 48, size: 4 }, crate::FieldLayout { name: Borrowed("roughness"), offset: 52, size: 4 }, crate::FieldLayout { name: Borrowed("environment_level"), offset: 56, size: 4 }, crate::FieldLayout { name: Borrowed("environment_inset"), offset: 60, size: 4 }, crate::FieldLayout { name: Borrowed("emission"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("padding"), offset: 76, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[crate::Override { key: Borrowed("textured"), required: false }, ]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE), };
/// Names of the entry points.
pub mod entry {
/// `fragment`.
pub const FRAGMENT: &str = "fragment";
/// `masked_fragment`.
pub const MASKED_FRAGMENT: &str = "masked_fragment";
/// `vertex`.
pub const VERTEX: &str = "vertex";
/// `masked_vertex`.
pub const MASKED_VERTEX: &str = "masked_vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `materials`.
pub const MATERIALS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `base_colour_texture`.
pub const BASE_COLOUR_TEXTURE: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 0 };
/// `base_colour_sampler`.
pub const BASE_COLOUR_SAMPLER: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/judge_draws.wgsl`.
pub mod judge_draws {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/judge_draws.wgsl"), include_str!("../wgsl/shared/prefix_sum.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("judge_draws"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/judge_draws.wgsl"), first_line: 1, lines: 102 }, crate::SourcePart { file: Borrowed("wgsl/shared/prefix_sum.wgsl"), first_line: 103, lines: 29 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("few"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("many"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("settings"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(16) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("few"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("many"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("templates"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(20) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("few"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("many"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("members"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("few"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("many"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("chosen"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("few"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("many"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("draws"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("few"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("many"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("kept"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("few"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("many"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("DrawTemplate"), kind: crate::LayoutKind::Memory, size: 20, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("elements"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("first_element"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("base_vertex"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("first_member"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("members"), offset: 16, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Settings"), kind: crate::LayoutKind::Memory, size: 16, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("count"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("words"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 12, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `few`.
pub const FEW: &str = "few";
/// `many`.
pub const MANY: &str = "many";
}
/// Places of the variables in use.
pub mod binding {
/// `settings`.
pub const SETTINGS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `templates`.
pub const TEMPLATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `members`.
pub const MEMBERS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `chosen`.
pub const CHOSEN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `draws`.
pub const DRAWS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `kept`.
pub const KEPT: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `few`.
pub const FEW: [u32; 3] = [64, 1, 1];
/// Of `many`.
pub const MANY: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/judge_first.wgsl`.
pub mod judge_first {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/judge_first.wgsl"), include_str!("../wgsl/shared/judged.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("judge_first"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/judge_first.wgsl"), first_line: 1, lines: 33 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged.wgsl"), first_line: 34, lines: 126 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 160, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 178, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 206, lines: 12 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("choose"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(128) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("choose"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("choose"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("states"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("choose"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("first"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("choose"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("JudgedView"), kind: crate::LayoutKind::Memory, size: 128, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 96, size: 4 }, crate::FieldLayout { name: Borrowed("depth_step"), offset: 100, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 104, size: 4 }, crate::FieldLayout { name: Borrowed("flags"), offset: 108, size: 4 }, crate::FieldLayout { name: Borrowed("shift"), offset: 112, size: 4 }, crate::FieldLayout { name: Borrowed("drift_x"), offset: 116, size: 4 }, crate::FieldLayout { name: Borrowed("drift_y"), offset: 120, size: 4 }, crate::FieldLayout { name: Borrowed("drift_w"), offset: 124, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `choose`.
pub const CHOOSE: &str = "choose";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `states`.
pub const STATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `first`.
pub const FIRST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `choose`.
pub const CHOOSE: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/judge_many.wgsl`.
pub mod judge_many {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/judge_many.wgsl"), include_str!("../wgsl/shared/judge.wgsl"), include_str!("../wgsl/shared/look_together.wgsl"), include_str!("../wgsl/shared/box_test.wgsl"), include_str!("../wgsl/shared/judged.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/seen_shape.wgsl"), include_str!("../wgsl/shared/depth_many.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("judge_many"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/judge_many.wgsl"), first_line: 1, lines: 3 }, crate::SourcePart { file: Borrowed("wgsl/shared/judge.wgsl"), first_line: 4, lines: 53 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_together.wgsl"), first_line: 57, lines: 20 }, crate::SourcePart { file: Borrowed("wgsl/shared/box_test.wgsl"), first_line: 77, lines: 191 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged.wgsl"), first_line: 268, lines: 126 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 394, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 412, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 440, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 452, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/seen_shape.wgsl"), first_line: 474, lines: 243 }, crate::SourcePart { file: Borrowed("wgsl/shared/depth_many.wgsl"), first_line: 717, lines: 11 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(128) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("states"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("rest"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("hidden"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("depth"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: true }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("first"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("JudgedView"), kind: crate::LayoutKind::Memory, size: 128, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 96, size: 4 }, crate::FieldLayout { name: Borrowed("depth_step"), offset: 100, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 104, size: 4 }, crate::FieldLayout { name: Borrowed("flags"), offset: 108, size: 4 }, crate::FieldLayout { name: Borrowed("shift"), offset: 112, size: 4 }, crate::FieldLayout { name: Borrowed("drift_x"), offset: 116, size: 4 }, crate::FieldLayout { name: Borrowed("drift_y"), offset: 120, size: 4 }, crate::FieldLayout { name: Borrowed("drift_w"), offset: 124, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `test`.
pub const TEST: &str = "test";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `states`.
pub const STATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `rest`.
pub const REST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `hidden`.
pub const HIDDEN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `depth`.
pub const DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
/// `first`.
pub const FIRST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `test`.
pub const TEST: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/judge_one.wgsl`.
pub mod judge_one {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/judge_one.wgsl"), include_str!("../wgsl/shared/judge.wgsl"), include_str!("../wgsl/shared/look_together.wgsl"), include_str!("../wgsl/shared/box_test.wgsl"), include_str!("../wgsl/shared/judged.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/seen_shape.wgsl"), include_str!("../wgsl/shared/depth_one.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("judge_one"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/judge_one.wgsl"), first_line: 1, lines: 3 }, crate::SourcePart { file: Borrowed("wgsl/shared/judge.wgsl"), first_line: 4, lines: 53 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_together.wgsl"), first_line: 57, lines: 20 }, crate::SourcePart { file: Borrowed("wgsl/shared/box_test.wgsl"), first_line: 77, lines: 191 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged.wgsl"), first_line: 268, lines: 126 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 394, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 412, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 440, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 452, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/seen_shape.wgsl"), first_line: 474, lines: 243 }, crate::SourcePart { file: Borrowed("wgsl/shared/depth_one.wgsl"), first_line: 717, lines: 7 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(128) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("states"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("rest"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("hidden"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("depth"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("first"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("JudgedView"), kind: crate::LayoutKind::Memory, size: 128, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 96, size: 4 }, crate::FieldLayout { name: Borrowed("depth_step"), offset: 100, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 104, size: 4 }, crate::FieldLayout { name: Borrowed("flags"), offset: 108, size: 4 }, crate::FieldLayout { name: Borrowed("shift"), offset: 112, size: 4 }, crate::FieldLayout { name: Borrowed("drift_x"), offset: 116, size: 4 }, crate::FieldLayout { name: Borrowed("drift_y"), offset: 120, size: 4 }, crate::FieldLayout { name: Borrowed("drift_w"), offset: 124, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `test`.
pub const TEST: &str = "test";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `states`.
pub const STATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `rest`.
pub const REST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `hidden`.
pub const HIDDEN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `depth`.
pub const DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
/// `first`.
pub const FIRST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `test`.
pub const TEST: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/max_counts.wgsl`.
pub mod max_counts {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/max_counts.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("max_counts"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/max_counts.wgsl"), first_line: 1, lines: 13 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("max_counts"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("first"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("max_counts"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("second"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("max_counts"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("merged"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("max_counts"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `max_counts`.
pub const MAX_COUNTS: &str = "max_counts";
}
/// Places of the variables in use.
pub mod binding {
/// `first`.
pub const FIRST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `second`.
pub const SECOND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `merged`.
pub const MERGED: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `max_counts`.
pub const MAX_COUNTS: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/patch_compare.wgsl`.
pub mod patch_compare {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/patch_compare.wgsl"), include_str!("../wgsl/shared/patch.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), include_str!("../wgsl/shared/material.wgsl"), include_str!("../wgsl/shared/marks.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("patch_compare"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/patch_compare.wgsl"), first_line: 1, lines: 24 }, crate::SourcePart { file: Borrowed("wgsl/shared/patch.wgsl"), first_line: 25, lines: 66 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 91, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 107, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 121, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 132, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 144, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/material.wgsl"), first_line: 154, lines: 43 }, crate::SourcePart { file: Borrowed("wgsl/shared/marks.wgsl"), first_line: 197, lines: 16 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 5, name: Borrowed("patch_number"), format: wgpu::VertexFormat::Uint32 }, ]),
}, crate::EntryPoint { name: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 2, name: Borrowed("normal"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 3, name: Borrowed("uv"), format: wgpu::VertexFormat::Float32x2 }, crate::VertexInput { location: 4, name: Borrowed("colour"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 5, name: Borrowed("patch_number"), format: wgpu::VertexFormat::Uint32 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("materials"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(80) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_texture"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: true }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_sampler"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("shown"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("finished_depth"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Material"), kind: crate::LayoutKind::Memory, size: 80, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("base_colour"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("uv_u"), offset: 16, size: 12 }, crate::FieldLayout { name: Borrowed("alpha_cutoff"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("uv_v"), offset: 32, size: 12 }, crate::FieldLayout { name: Borrowed("unlit"), offset: 44, size: 4 }, crate::FieldLayout { name: Borrowed("metallic"), offset: 48, size: 4 }, crate::FieldLayout { name: Borrowed("roughness"), offset: 52, size: 4 }, crate::FieldLayout { name: Borrowed("environment_level"), offset: 56, size: 4 }, crate::FieldLayout { name: Borrowed("environment_inset"), offset: 60, size: 4 }, crate::FieldLayout { name: Borrowed("emission"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("padding"), offset: 76, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[crate::Override { key: Borrowed("textured"), required: false }, ]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE).union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE), };
/// Names of the entry points.
pub mod entry {
/// `fragment`.
pub const FRAGMENT: &str = "fragment";
/// `textured_fragment`.
pub const TEXTURED_FRAGMENT: &str = "textured_fragment";
/// `vertex`.
pub const VERTEX: &str = "vertex";
/// `textured_vertex`.
pub const TEXTURED_VERTEX: &str = "textured_vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `materials`.
pub const MATERIALS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `base_colour_texture`.
pub const BASE_COLOUR_TEXTURE: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 0 };
/// `base_colour_sampler`.
pub const BASE_COLOUR_SAMPLER: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 1 };
/// `shown`.
pub const SHOWN: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 0 };
/// `finished_depth`.
pub const FINISHED_DEPTH: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/patch_compare_many.wgsl`.
pub mod patch_compare_many {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/patch_compare_many.wgsl"), include_str!("../wgsl/shared/patch.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), include_str!("../wgsl/shared/material.wgsl"), include_str!("../wgsl/shared/marks.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("patch_compare_many"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/patch_compare_many.wgsl"), first_line: 1, lines: 23 }, crate::SourcePart { file: Borrowed("wgsl/shared/patch.wgsl"), first_line: 24, lines: 66 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 90, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 106, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 120, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 131, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 143, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/material.wgsl"), first_line: 153, lines: 43 }, crate::SourcePart { file: Borrowed("wgsl/shared/marks.wgsl"), first_line: 196, lines: 16 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 5, name: Borrowed("patch_number"), format: wgpu::VertexFormat::Uint32 }, ]),
}, crate::EntryPoint { name: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 2, name: Borrowed("normal"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 3, name: Borrowed("uv"), format: wgpu::VertexFormat::Float32x2 }, crate::VertexInput { location: 4, name: Borrowed("colour"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 5, name: Borrowed("patch_number"), format: wgpu::VertexFormat::Uint32 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("materials"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(80) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_texture"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: true }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_sampler"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("shown"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("finished_depth"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: true }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Material"), kind: crate::LayoutKind::Memory, size: 80, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("base_colour"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("uv_u"), offset: 16, size: 12 }, crate::FieldLayout { name: Borrowed("alpha_cutoff"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("uv_v"), offset: 32, size: 12 }, crate::FieldLayout { name: Borrowed("unlit"), offset: 44, size: 4 }, crate::FieldLayout { name: Borrowed("metallic"), offset: 48, size: 4 }, crate::FieldLayout { name: Borrowed("roughness"), offset: 52, size: 4 }, crate::FieldLayout { name: Borrowed("environment_level"), offset: 56, size: 4 }, crate::FieldLayout { name: Borrowed("environment_inset"), offset: 60, size: 4 }, crate::FieldLayout { name: Borrowed("emission"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("padding"), offset: 76, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[crate::Override { key: Borrowed("textured"), required: false }, ]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE).union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE).union(wgpu::DownlevelFlags::MULTISAMPLED_SHADING), };
/// Names of the entry points.
pub mod entry {
/// `fragment_of_samples`.
pub const FRAGMENT_OF_SAMPLES: &str = "fragment_of_samples";
/// `textured_fragment_of_samples`.
pub const TEXTURED_FRAGMENT_OF_SAMPLES: &str = "textured_fragment_of_samples";
/// `vertex`.
pub const VERTEX: &str = "vertex";
/// `textured_vertex`.
pub const TEXTURED_VERTEX: &str = "textured_vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `materials`.
pub const MATERIALS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `base_colour_texture`.
pub const BASE_COLOUR_TEXTURE: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 0 };
/// `base_colour_sampler`.
pub const BASE_COLOUR_SAMPLER: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 1 };
/// `shown`.
pub const SHOWN: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 0 };
/// `finished_depth`.
pub const FINISHED_DEPTH: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/patch_early.wgsl`.
pub mod patch_early {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/patch_early.wgsl"), include_str!("../wgsl/shared/patch.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), include_str!("../wgsl/shared/material.wgsl"), include_str!("../wgsl/shared/marks.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("patch_early"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/patch_early.wgsl"), first_line: 1, lines: 32 }, crate::SourcePart { file: Borrowed("wgsl/shared/patch.wgsl"), first_line: 33, lines: 66 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 99, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 115, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 129, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 140, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 152, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/material.wgsl"), first_line: 162, lines: 43 }, crate::SourcePart { file: Borrowed("wgsl/shared/marks.wgsl"), first_line: 205, lines: 16 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: true, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: true, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: true, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: true, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 5, name: Borrowed("patch_number"), format: wgpu::VertexFormat::Uint32 }, ]),
}, crate::EntryPoint { name: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 2, name: Borrowed("normal"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 3, name: Borrowed("uv"), format: wgpu::VertexFormat::Float32x2 }, crate::VertexInput { location: 4, name: Borrowed("colour"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 5, name: Borrowed("patch_number"), format: wgpu::VertexFormat::Uint32 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("materials"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(80) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_texture"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: true }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_sampler"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("shown"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("textured_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Material"), kind: crate::LayoutKind::Memory, size: 80, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("base_colour"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("uv_u"), offset: 16, size: 12 }, crate::FieldLayout { name: Borrowed("alpha_cutoff"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("uv_v"), offset: 32, size: 12 }, crate::FieldLayout { name: Borrowed("unlit"), offset: 44, size: 4 }, crate::FieldLayout { name: Borrowed("metallic"), offset: 48, size: 4 }, crate::FieldLayout { name: Borrowed("roughness"), offset: 52, size: 4 }, crate::FieldLayout { name: Borrowed("environment_level"), offset: 56, size: 4 }, crate::FieldLayout { name: Borrowed("environment_inset"), offset: 60, size: 4 }, crate::FieldLayout { name: Borrowed("emission"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("padding"), offset: 76, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[crate::Override { key: Borrowed("textured"), required: false }, ]),
immediate_size: 0,
features: wgpu::Features::empty().union(wgpu::Features::SHADER_EARLY_DEPTH_TEST), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE).union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE).union(wgpu::DownlevelFlags::MULTISAMPLED_SHADING), };
/// Names of the entry points.
pub mod entry {
/// `fragment`.
pub const FRAGMENT: &str = "fragment";
/// `textured_fragment`.
pub const TEXTURED_FRAGMENT: &str = "textured_fragment";
/// `fragment_of_samples`.
pub const FRAGMENT_OF_SAMPLES: &str = "fragment_of_samples";
/// `textured_fragment_of_samples`.
pub const TEXTURED_FRAGMENT_OF_SAMPLES: &str = "textured_fragment_of_samples";
/// `vertex`.
pub const VERTEX: &str = "vertex";
/// `textured_vertex`.
pub const TEXTURED_VERTEX: &str = "textured_vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `materials`.
pub const MATERIALS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `base_colour_texture`.
pub const BASE_COLOUR_TEXTURE: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 0 };
/// `base_colour_sampler`.
pub const BASE_COLOUR_SAMPLER: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 1 };
/// `shown`.
pub const SHOWN: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 0 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/pyramid_many.wgsl`.
pub mod pyramid_many {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/pyramid_many.wgsl"), include_str!("../wgsl/shared/reduce.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/depth_many.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("pyramid_many"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/pyramid_many.wgsl"), first_line: 1, lines: 3 }, crate::SourcePart { file: Borrowed("wgsl/shared/reduce.wgsl"), first_line: 4, lines: 39 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 43, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/depth_many.wgsl"), first_line: 65, lines: 11 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("reduce"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("reduce"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("reduce"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("depth"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: true }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("reduce"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `reduce`.
pub const REDUCE: &str = "reduce";
}
/// Places of the variables in use.
pub mod binding {
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `depth`.
pub const DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `reduce`.
pub const REDUCE: [u32; 3] = [8, 8, 1];
}
}
/// `wgsl/pyramid_one.wgsl`.
pub mod pyramid_one {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/pyramid_one.wgsl"), include_str!("../wgsl/shared/reduce.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/depth_one.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("pyramid_one"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/pyramid_one.wgsl"), first_line: 1, lines: 3 }, crate::SourcePart { file: Borrowed("wgsl/shared/reduce.wgsl"), first_line: 4, lines: 39 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 43, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/depth_one.wgsl"), first_line: 65, lines: 7 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("reduce"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("reduce"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("reduce"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("depth"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("reduce"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `reduce`.
pub const REDUCE: &str = "reduce";
}
/// Places of the variables in use.
pub mod binding {
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `depth`.
pub const DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `reduce`.
pub const REDUCE: [u32; 3] = [8, 8, 1];
}
}
/// `wgsl/pyramid_rest.wgsl`.
pub mod pyramid_rest {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/pyramid_rest.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("pyramid_rest"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/pyramid_rest.wgsl"), first_line: 1, lines: 21 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 22, lines: 22 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `rest`.
pub const REST: &str = "rest";
}
/// Places of the variables in use.
pub mod binding {
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `rest`.
pub const REST: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/recall_slots.wgsl`.
pub mod recall_slots {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/recall_slots.wgsl"), include_str!("../wgsl/shared/slot_state_of.wgsl"), include_str!("../wgsl/shared/look_together.wgsl"), include_str!("../wgsl/shared/box_test.wgsl"), include_str!("../wgsl/shared/judged.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/seen_shape.wgsl"), include_str!("../wgsl/shared/look_at_parts.wgsl"), include_str!("../wgsl/shared/part_box.wgsl"), include_str!("../wgsl/shared/screen_size.wgsl"), include_str!("../wgsl/shared/slot_states.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("recall_slots"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/recall_slots.wgsl"), first_line: 1, lines: 21 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_state_of.wgsl"), first_line: 22, lines: 32 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_together.wgsl"), first_line: 54, lines: 20 }, crate::SourcePart { file: Borrowed("wgsl/shared/box_test.wgsl"), first_line: 74, lines: 191 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged.wgsl"), first_line: 265, lines: 126 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 391, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 409, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 437, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 449, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/seen_shape.wgsl"), first_line: 471, lines: 243 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_at_parts.wgsl"), first_line: 714, lines: 37 }, crate::SourcePart { file: Borrowed("wgsl/shared/part_box.wgsl"), first_line: 751, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/screen_size.wgsl"), first_line: 779, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_states.wgsl"), first_line: 790, lines: 6 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("recall_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(128) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("recall_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("recall_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("states"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("recall_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("recall_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("recall_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("part_boxes"), entry: wgpu::BindGroupLayoutEntry { binding: 9, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(8) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("recall_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("JudgedView"), kind: crate::LayoutKind::Memory, size: 128, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 96, size: 4 }, crate::FieldLayout { name: Borrowed("depth_step"), offset: 100, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 104, size: 4 }, crate::FieldLayout { name: Borrowed("flags"), offset: 108, size: 4 }, crate::FieldLayout { name: Borrowed("shift"), offset: 112, size: 4 }, crate::FieldLayout { name: Borrowed("drift_x"), offset: 116, size: 4 }, crate::FieldLayout { name: Borrowed("drift_y"), offset: 120, size: 4 }, crate::FieldLayout { name: Borrowed("drift_w"), offset: 124, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `recall_slots`.
pub const RECALL_SLOTS: &str = "recall_slots";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `states`.
pub const STATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `part_boxes`.
pub const PART_BOXES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 9 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `recall_slots`.
pub const RECALL_SLOTS: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/retest_slots_many.wgsl`.
pub mod retest_slots_many {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/retest_slots_many.wgsl"), include_str!("../wgsl/shared/retest_slots.wgsl"), include_str!("../wgsl/shared/slot_state_of.wgsl"), include_str!("../wgsl/shared/look_together.wgsl"), include_str!("../wgsl/shared/box_test.wgsl"), include_str!("../wgsl/shared/judged.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/seen_shape.wgsl"), include_str!("../wgsl/shared/look_at_parts.wgsl"), include_str!("../wgsl/shared/part_box.wgsl"), include_str!("../wgsl/shared/screen_size.wgsl"), include_str!("../wgsl/shared/slot_states.wgsl"), include_str!("../wgsl/shared/depth_many.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("retest_slots_many"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/retest_slots_many.wgsl"), first_line: 1, lines: 3 }, crate::SourcePart { file: Borrowed("wgsl/shared/retest_slots.wgsl"), first_line: 4, lines: 20 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_state_of.wgsl"), first_line: 24, lines: 32 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_together.wgsl"), first_line: 56, lines: 20 }, crate::SourcePart { file: Borrowed("wgsl/shared/box_test.wgsl"), first_line: 76, lines: 191 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged.wgsl"), first_line: 267, lines: 126 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 393, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 411, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 439, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 451, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/seen_shape.wgsl"), first_line: 473, lines: 243 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_at_parts.wgsl"), first_line: 716, lines: 37 }, crate::SourcePart { file: Borrowed("wgsl/shared/part_box.wgsl"), first_line: 753, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/screen_size.wgsl"), first_line: 781, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_states.wgsl"), first_line: 792, lines: 6 }, crate::SourcePart { file: Borrowed("wgsl/shared/depth_many.wgsl"), first_line: 798, lines: 11 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(128) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("drawn"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("states"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("depth"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: true }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("part_boxes"), entry: wgpu::BindGroupLayoutEntry { binding: 9, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(8) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("JudgedView"), kind: crate::LayoutKind::Memory, size: 128, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 96, size: 4 }, crate::FieldLayout { name: Borrowed("depth_step"), offset: 100, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 104, size: 4 }, crate::FieldLayout { name: Borrowed("flags"), offset: 108, size: 4 }, crate::FieldLayout { name: Borrowed("shift"), offset: 112, size: 4 }, crate::FieldLayout { name: Borrowed("drift_x"), offset: 116, size: 4 }, crate::FieldLayout { name: Borrowed("drift_y"), offset: 120, size: 4 }, crate::FieldLayout { name: Borrowed("drift_w"), offset: 124, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `retest_slots`.
pub const RETEST_SLOTS: &str = "retest_slots";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `drawn`.
pub const DRAWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `states`.
pub const STATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `depth`.
pub const DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
/// `part_boxes`.
pub const PART_BOXES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 9 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `retest_slots`.
pub const RETEST_SLOTS: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/retest_slots_one.wgsl`.
pub mod retest_slots_one {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/retest_slots_one.wgsl"), include_str!("../wgsl/shared/retest_slots.wgsl"), include_str!("../wgsl/shared/slot_state_of.wgsl"), include_str!("../wgsl/shared/look_together.wgsl"), include_str!("../wgsl/shared/box_test.wgsl"), include_str!("../wgsl/shared/judged.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/seen_shape.wgsl"), include_str!("../wgsl/shared/look_at_parts.wgsl"), include_str!("../wgsl/shared/part_box.wgsl"), include_str!("../wgsl/shared/screen_size.wgsl"), include_str!("../wgsl/shared/slot_states.wgsl"), include_str!("../wgsl/shared/depth_one.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("retest_slots_one"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/retest_slots_one.wgsl"), first_line: 1, lines: 3 }, crate::SourcePart { file: Borrowed("wgsl/shared/retest_slots.wgsl"), first_line: 4, lines: 20 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_state_of.wgsl"), first_line: 24, lines: 32 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_together.wgsl"), first_line: 56, lines: 20 }, crate::SourcePart { file: Borrowed("wgsl/shared/box_test.wgsl"), first_line: 76, lines: 191 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged.wgsl"), first_line: 267, lines: 126 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 393, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 411, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 439, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 451, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/seen_shape.wgsl"), first_line: 473, lines: 243 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_at_parts.wgsl"), first_line: 716, lines: 37 }, crate::SourcePart { file: Borrowed("wgsl/shared/part_box.wgsl"), first_line: 753, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/screen_size.wgsl"), first_line: 781, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_states.wgsl"), first_line: 792, lines: 6 }, crate::SourcePart { file: Borrowed("wgsl/shared/depth_one.wgsl"), first_line: 798, lines: 7 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(128) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("drawn"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("states"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("depth"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("part_boxes"), entry: wgpu::BindGroupLayoutEntry { binding: 9, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(8) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("retest_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("JudgedView"), kind: crate::LayoutKind::Memory, size: 128, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 96, size: 4 }, crate::FieldLayout { name: Borrowed("depth_step"), offset: 100, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 104, size: 4 }, crate::FieldLayout { name: Borrowed("flags"), offset: 108, size: 4 }, crate::FieldLayout { name: Borrowed("shift"), offset: 112, size: 4 }, crate::FieldLayout { name: Borrowed("drift_x"), offset: 116, size: 4 }, crate::FieldLayout { name: Borrowed("drift_y"), offset: 120, size: 4 }, crate::FieldLayout { name: Borrowed("drift_w"), offset: 124, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `retest_slots`.
pub const RETEST_SLOTS: &str = "retest_slots";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `drawn`.
pub const DRAWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `states`.
pub const STATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `depth`.
pub const DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
/// `part_boxes`.
pub const PART_BOXES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 9 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `retest_slots`.
pub const RETEST_SLOTS: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/rival_bevy.wgsl`.
pub mod rival_bevy {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/rival_bevy.wgsl"), include_str!("../wgsl/shared/rival_slots.wgsl"), include_str!("../wgsl/shared/rival.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("rival_bevy"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/rival_bevy.wgsl"), first_line: 1, lines: 31 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival_slots.wgsl"), first_line: 32, lines: 39 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival.wgsl"), first_line: 71, lines: 99 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 170, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 188, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 216, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 228, lines: 22 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(240) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("seen"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("found"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("rest_found"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("drawn"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("RivalView"), kind: crate::LayoutKind::Memory, size: 240, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("view_from_relative"), offset: 64, size: 64 }, crate::FieldLayout { name: Borrowed("clip_from_view"), offset: 128, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 192, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 204, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 208, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 220, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 224, size: 4 }, crate::FieldLayout { name: Borrowed("on_axis"), offset: 228, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 232, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 236, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `first`.
pub const FIRST: &str = "first";
/// `rest`.
pub const REST: &str = "rest";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `seen`.
pub const SEEN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `found`.
pub const FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `rest_found`.
pub const REST_FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `drawn`.
pub const DRAWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `first`.
pub const FIRST: [u32; 3] = [64, 1, 1];
/// Of `rest`.
pub const REST: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/rival_bevy_meshlets.wgsl`.
pub mod rival_bevy_meshlets {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/rival_bevy_meshlets.wgsl"), include_str!("../wgsl/shared/rival_slots.wgsl"), include_str!("../wgsl/shared/rival.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("rival_bevy_meshlets"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/rival_bevy_meshlets.wgsl"), first_line: 1, lines: 26 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival_slots.wgsl"), first_line: 27, lines: 39 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival.wgsl"), first_line: 66, lines: 99 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 165, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 183, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 211, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 223, lines: 22 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(240) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("seen"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("found"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("rest_found"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("drawn"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("RivalView"), kind: crate::LayoutKind::Memory, size: 240, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("view_from_relative"), offset: 64, size: 64 }, crate::FieldLayout { name: Borrowed("clip_from_view"), offset: 128, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 192, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 204, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 208, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 220, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 224, size: 4 }, crate::FieldLayout { name: Borrowed("on_axis"), offset: 228, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 232, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 236, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `first`.
pub const FIRST: &str = "first";
/// `rest`.
pub const REST: &str = "rest";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `seen`.
pub const SEEN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `found`.
pub const FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `rest_found`.
pub const REST_FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `drawn`.
pub const DRAWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `first`.
pub const FIRST: [u32; 3] = [64, 1, 1];
/// Of `rest`.
pub const REST: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/rival_helio.wgsl`.
pub mod rival_helio {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/rival_helio.wgsl"), include_str!("../wgsl/shared/rival_slots.wgsl"), include_str!("../wgsl/shared/rival.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("rival_helio"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/rival_helio.wgsl"), first_line: 1, lines: 47 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival_slots.wgsl"), first_line: 48, lines: 39 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival.wgsl"), first_line: 87, lines: 99 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 186, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 204, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 232, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 244, lines: 22 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(240) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("seen"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("found"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("rest_found"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("drawn"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("RivalView"), kind: crate::LayoutKind::Memory, size: 240, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("view_from_relative"), offset: 64, size: 64 }, crate::FieldLayout { name: Borrowed("clip_from_view"), offset: 128, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 192, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 204, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 208, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 220, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 224, size: 4 }, crate::FieldLayout { name: Borrowed("on_axis"), offset: 228, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 232, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 236, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `first`.
pub const FIRST: &str = "first";
/// `rest`.
pub const REST: &str = "rest";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `seen`.
pub const SEEN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `found`.
pub const FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `rest_found`.
pub const REST_FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `drawn`.
pub const DRAWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `first`.
pub const FIRST: [u32; 3] = [64, 1, 1];
/// Of `rest`.
pub const REST: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/rival_niagara.wgsl`.
pub mod rival_niagara {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/rival_niagara.wgsl"), include_str!("../wgsl/shared/rival_slots.wgsl"), include_str!("../wgsl/shared/rival.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("rival_niagara"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/rival_niagara.wgsl"), first_line: 1, lines: 35 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival_slots.wgsl"), first_line: 36, lines: 39 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival.wgsl"), first_line: 75, lines: 99 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 174, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 192, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 220, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 232, lines: 22 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(240) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("seen"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("found"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("rest_found"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("drawn"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("RivalView"), kind: crate::LayoutKind::Memory, size: 240, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("view_from_relative"), offset: 64, size: 64 }, crate::FieldLayout { name: Borrowed("clip_from_view"), offset: 128, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 192, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 204, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 208, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 220, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 224, size: 4 }, crate::FieldLayout { name: Borrowed("on_axis"), offset: 228, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 232, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 236, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `first`.
pub const FIRST: &str = "first";
/// `rest`.
pub const REST: &str = "rest";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `seen`.
pub const SEEN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `found`.
pub const FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `rest_found`.
pub const REST_FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `drawn`.
pub const DRAWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `first`.
pub const FIRST: [u32; 3] = [64, 1, 1];
/// Of `rest`.
pub const REST: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/rival_pyramid_many.wgsl`.
pub mod rival_pyramid_many {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/rival_pyramid_many.wgsl"), include_str!("../wgsl/shared/rival_pyramid.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/depth_many.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("rival_pyramid_many"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/rival_pyramid_many.wgsl"), first_line: 1, lines: 3 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival_pyramid.wgsl"), first_line: 4, lines: 86 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 90, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/depth_many.wgsl"), first_line: 112, lines: 11 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("copied"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("halved"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("in_eighths"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("sampled"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("enlarged"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("copied"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("halved"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("in_eighths"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("sampled"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("enlarged"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("copied"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("halved"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("in_eighths"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("sampled"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("enlarged"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("depth"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: true }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("copied"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("halved"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("in_eighths"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("sampled"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("enlarged"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `copied`.
pub const COPIED: &str = "copied";
/// `halved`.
pub const HALVED: &str = "halved";
/// `in_eighths`.
pub const IN_EIGHTHS: &str = "in_eighths";
/// `sampled`.
pub const SAMPLED: &str = "sampled";
/// `enlarged`.
pub const ENLARGED: &str = "enlarged";
}
/// Places of the variables in use.
pub mod binding {
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `depth`.
pub const DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `copied`.
pub const COPIED: [u32; 3] = [8, 8, 1];
/// Of `halved`.
pub const HALVED: [u32; 3] = [8, 8, 1];
/// Of `in_eighths`.
pub const IN_EIGHTHS: [u32; 3] = [8, 8, 1];
/// Of `sampled`.
pub const SAMPLED: [u32; 3] = [8, 8, 1];
/// Of `enlarged`.
pub const ENLARGED: [u32; 3] = [8, 8, 1];
}
}
/// `wgsl/rival_pyramid_one.wgsl`.
pub mod rival_pyramid_one {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/rival_pyramid_one.wgsl"), include_str!("../wgsl/shared/rival_pyramid.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/depth_one.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("rival_pyramid_one"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/rival_pyramid_one.wgsl"), first_line: 1, lines: 3 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival_pyramid.wgsl"), first_line: 4, lines: 86 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 90, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/depth_one.wgsl"), first_line: 112, lines: 7 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("copied"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("halved"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("in_eighths"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("sampled"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("enlarged"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [8, 8, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("copied"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("halved"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("in_eighths"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("sampled"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("enlarged"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("copied"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("halved"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("in_eighths"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("sampled"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("enlarged"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("depth"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("copied"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("halved"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("in_eighths"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("sampled"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("enlarged"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `copied`.
pub const COPIED: &str = "copied";
/// `halved`.
pub const HALVED: &str = "halved";
/// `in_eighths`.
pub const IN_EIGHTHS: &str = "in_eighths";
/// `sampled`.
pub const SAMPLED: &str = "sampled";
/// `enlarged`.
pub const ENLARGED: &str = "enlarged";
}
/// Places of the variables in use.
pub mod binding {
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `depth`.
pub const DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `copied`.
pub const COPIED: [u32; 3] = [8, 8, 1];
/// Of `halved`.
pub const HALVED: [u32; 3] = [8, 8, 1];
/// Of `in_eighths`.
pub const IN_EIGHTHS: [u32; 3] = [8, 8, 1];
/// Of `sampled`.
pub const SAMPLED: [u32; 3] = [8, 8, 1];
/// Of `enlarged`.
pub const ENLARGED: [u32; 3] = [8, 8, 1];
}
}
/// `wgsl/rival_pyramid_rest.wgsl`.
pub mod rival_pyramid_rest {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/rival_pyramid_rest.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("rival_pyramid_rest"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/rival_pyramid_rest.wgsl"), first_line: 1, lines: 40 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 41, lines: 22 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("level"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("levels"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("range"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(8) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("level"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("levels"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("level"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("levels"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("level"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("levels"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `level`.
pub const LEVEL: &str = "level";
/// `levels`.
pub const LEVELS: &str = "levels";
}
/// Places of the variables in use.
pub mod binding {
/// `range`.
pub const RANGE: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `level`.
pub const LEVEL: [u32; 3] = [64, 1, 1];
/// Of `levels`.
pub const LEVELS: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/rival_unity.wgsl`.
pub mod rival_unity {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/rival_unity.wgsl"), include_str!("../wgsl/shared/rival_slots.wgsl"), include_str!("../wgsl/shared/rival.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("rival_unity"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/rival_unity.wgsl"), first_line: 1, lines: 48 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival_slots.wgsl"), first_line: 49, lines: 39 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival.wgsl"), first_line: 88, lines: 99 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 187, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 205, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 233, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 245, lines: 22 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(240) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("seen"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("found"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("rest_found"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("drawn"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("RivalView"), kind: crate::LayoutKind::Memory, size: 240, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("view_from_relative"), offset: 64, size: 64 }, crate::FieldLayout { name: Borrowed("clip_from_view"), offset: 128, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 192, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 204, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 208, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 220, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 224, size: 4 }, crate::FieldLayout { name: Borrowed("on_axis"), offset: 228, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 232, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 236, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `first`.
pub const FIRST: &str = "first";
/// `rest`.
pub const REST: &str = "rest";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `seen`.
pub const SEEN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `found`.
pub const FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `rest_found`.
pub const REST_FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `drawn`.
pub const DRAWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `first`.
pub const FIRST: [u32; 3] = [64, 1, 1];
/// Of `rest`.
pub const REST: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/rival_vk_lod_clusters.wgsl`.
pub mod rival_vk_lod_clusters {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/rival_vk_lod_clusters.wgsl"), include_str!("../wgsl/shared/rival_slots.wgsl"), include_str!("../wgsl/shared/rival.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("rival_vk_lod_clusters"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/rival_vk_lod_clusters.wgsl"), first_line: 1, lines: 26 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival_slots.wgsl"), first_line: 27, lines: 39 }, crate::SourcePart { file: Borrowed("wgsl/shared/rival.wgsl"), first_line: 66, lines: 99 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 165, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 183, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 211, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 223, lines: 22 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(240) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("seen"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("found"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("rest_found"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("first"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("drawn"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("rest"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("RivalView"), kind: crate::LayoutKind::Memory, size: 240, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("view_from_relative"), offset: 64, size: 64 }, crate::FieldLayout { name: Borrowed("clip_from_view"), offset: 128, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 192, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 204, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 208, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 220, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 224, size: 4 }, crate::FieldLayout { name: Borrowed("on_axis"), offset: 228, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 232, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 236, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `first`.
pub const FIRST: &str = "first";
/// `rest`.
pub const REST: &str = "rest";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `seen`.
pub const SEEN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `found`.
pub const FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `rest_found`.
pub const REST_FOUND: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `drawn`.
pub const DRAWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `first`.
pub const FIRST: [u32; 3] = [64, 1, 1];
/// Of `rest`.
pub const REST: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/sample_identity.wgsl`.
pub mod sample_identity {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/sample_identity.wgsl"), include_str!("../wgsl/shared/identified.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), include_str!("../wgsl/shared/material.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("sample_identity"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/sample_identity.wgsl"), first_line: 1, lines: 50 }, crate::SourcePart { file: Borrowed("wgsl/shared/identified.wgsl"), first_line: 51, lines: 45 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 96, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 112, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 126, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 137, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 149, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/material.wgsl"), first_line: 159, lines: 43 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("masked_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("masked_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, ]),
}, crate::EntryPoint { name: Borrowed("masked_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 2, name: Borrowed("normal"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 3, name: Borrowed("uv"), format: wgpu::VertexFormat::Float32x2 }, crate::VertexInput { location: 4, name: Borrowed("colour"), format: wgpu::VertexFormat::Float32x4 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("masked_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("masked_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("masked_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("masked_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("materials"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(80) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("masked_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("masked_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("masked_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_texture"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: true }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("masked_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, crate::BindingUse { entry_point: Borrowed("masked_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_sampler"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("masked_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("masked_fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Material"), kind: crate::LayoutKind::Memory, size: 80, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("base_colour"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("uv_u"), offset: 16, size: 12 }, crate::FieldLayout { name: Borrowed("alpha_cutoff"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("uv_v"), offset: 32, size: 12 }, crate::FieldLayout { name: Borrowed("unlit"), offset: 44, size: 4 }, crate::FieldLayout { name: Borrowed("metallic"), offset: 48, size: 4 }, crate::FieldLayout { name: Borrowed("roughness"), offset: 52, size: 4 }, crate::FieldLayout { name: Borrowed("environment_level"), offset: 56, size: 4 }, crate::FieldLayout { name: Borrowed("environment_inset"), offset: 60, size: 4 }, crate::FieldLayout { name: Borrowed("emission"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("padding"), offset: 76, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[crate::Override { key: Borrowed("sample"), required: false }, crate::Override { key: Borrowed("textured"), required: false }, ]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE).union(wgpu::DownlevelFlags::MULTISAMPLED_SHADING), };
/// Names of the entry points.
pub mod entry {
/// `fragment`.
pub const FRAGMENT: &str = "fragment";
/// `masked_fragment`.
pub const MASKED_FRAGMENT: &str = "masked_fragment";
/// `fragment_of_samples`.
pub const FRAGMENT_OF_SAMPLES: &str = "fragment_of_samples";
/// `masked_fragment_of_samples`.
pub const MASKED_FRAGMENT_OF_SAMPLES: &str = "masked_fragment_of_samples";
/// `vertex`.
pub const VERTEX: &str = "vertex";
/// `masked_vertex`.
pub const MASKED_VERTEX: &str = "masked_vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `materials`.
pub const MATERIALS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `base_colour_texture`.
pub const BASE_COLOUR_TEXTURE: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 0 };
/// `base_colour_sampler`.
pub const BASE_COLOUR_SAMPLER: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/scatter.wgsl`.
pub mod scatter {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/scatter.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("scatter"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/scatter.wgsl"), first_line: 1, lines: 24 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("scatter"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("settings"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(16) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("scatter"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("asked"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("scatter"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("answers"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(8) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("scatter"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("counts"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("scatter"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Settings"), kind: crate::LayoutKind::Memory, size: 16, align: 4, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("queries"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 12, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `scatter`.
pub const SCATTER: &str = "scatter";
}
/// Places of the variables in use.
pub mod binding {
/// `settings`.
pub const SETTINGS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `asked`.
pub const ASKED: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `answers`.
pub const ANSWERS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `counts`.
pub const COUNTS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `scatter`.
pub const SCATTER: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/scatter_records.wgsl`.
pub mod scatter_records {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/scatter_records.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("scatter_records"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/scatter_records.wgsl"), first_line: 1, lines: 15 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 16, lines: 18 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("scatter_records"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("places"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("scatter_records"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("moved"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("scatter_records"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("records"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("scatter_records"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `scatter_records`.
pub const SCATTER_RECORDS: &str = "scatter_records";
}
/// Places of the variables in use.
pub mod binding {
/// `places`.
pub const PLACES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `moved`.
pub const MOVED: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `records`.
pub const RECORDS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `scatter_records`.
pub const SCATTER_RECORDS: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/shaded.wgsl`.
pub mod shaded {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/shaded.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), include_str!("../wgsl/shared/material.wgsl"), include_str!("../wgsl/shared/light.wgsl"), include_str!("../wgsl/shared/environment.wgsl"), include_str!("../wgsl/shared/packed_id.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("shaded"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/shaded.wgsl"), first_line: 1, lines: 172 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 173, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 189, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 203, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 214, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 226, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/material.wgsl"), first_line: 236, lines: 43 }, crate::SourcePart { file: Borrowed("wgsl/shared/light.wgsl"), first_line: 279, lines: 76 }, crate::SourcePart { file: Borrowed("wgsl/shared/environment.wgsl"), first_line: 355, lines: 21 }, crate::SourcePart { file: Borrowed("wgsl/shared/packed_id.wgsl"), first_line: 376, lines: 10 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 2, name: Borrowed("normal"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 3, name: Borrowed("uv"), format: wgpu::VertexFormat::Float32x2 }, crate::VertexInput { location: 4, name: Borrowed("colour"), format: wgpu::VertexFormat::Float32x4 }, ]),
}, crate::EntryPoint { name: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("identified_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 2, name: Borrowed("normal"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 3, name: Borrowed("uv"), format: wgpu::VertexFormat::Float32x2 }, crate::VertexInput { location: 4, name: Borrowed("colour"), format: wgpu::VertexFormat::Float32x4 }, ]),
}, crate::EntryPoint { name: Borrowed("identified_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("identified_reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("identified_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("identified_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("materials"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(80) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("identified_vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, crate::BindingUse { entry_point: Borrowed("identified_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("identified_reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("lights"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(528) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("identified_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("identified_reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_texture"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: true }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, crate::BindingUse { entry_point: Borrowed("reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, crate::BindingUse { entry_point: Borrowed("identified_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, crate::BindingUse { entry_point: Borrowed("identified_reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_sampler"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("identified_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("identified_reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("environment_texture"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: true }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, crate::BindingUse { entry_point: Borrowed("identified_reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, ]),
}, crate::Binding { group: 3, name: Borrowed("environment_sampler"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("identified_reflecting_fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Light"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("colour"), offset: 0, size: 12 }, crate::FieldLayout { name: Borrowed("kind"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("direction"), offset: 16, size: 12 }, crate::FieldLayout { name: Borrowed("range"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("position"), offset: 32, size: 12 }, crate::FieldLayout { name: Borrowed("cos_outer"), offset: 44, size: 4 }, crate::FieldLayout { name: Borrowed("cos_inner"), offset: 48, size: 4 }, crate::FieldLayout { name: Borrowed("reference_distance"), offset: 52, size: 4 }, crate::FieldLayout { name: Borrowed("padding"), offset: 56, size: 8 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Lights"), kind: crate::LayoutKind::Memory, size: 528, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("ambient"), offset: 0, size: 12 }, crate::FieldLayout { name: Borrowed("count"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("lights"), offset: 16, size: 512 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Material"), kind: crate::LayoutKind::Memory, size: 80, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("base_colour"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("uv_u"), offset: 16, size: 12 }, crate::FieldLayout { name: Borrowed("alpha_cutoff"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("uv_v"), offset: 32, size: 12 }, crate::FieldLayout { name: Borrowed("unlit"), offset: 44, size: 4 }, crate::FieldLayout { name: Borrowed("metallic"), offset: 48, size: 4 }, crate::FieldLayout { name: Borrowed("roughness"), offset: 52, size: 4 }, crate::FieldLayout { name: Borrowed("environment_level"), offset: 56, size: 4 }, crate::FieldLayout { name: Borrowed("environment_inset"), offset: 60, size: 4 }, crate::FieldLayout { name: Borrowed("emission"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("padding"), offset: 76, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[crate::Override { key: Borrowed("alpha_mode"), required: false }, crate::Override { key: Borrowed("textured"), required: false }, crate::Override { key: Borrowed("positional_lights"), required: false }, ]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE), };
/// Names of the entry points.
pub mod entry {
/// `vertex`.
pub const VERTEX: &str = "vertex";
/// `fragment`.
pub const FRAGMENT: &str = "fragment";
/// `reflecting_fragment`.
pub const REFLECTING_FRAGMENT: &str = "reflecting_fragment";
/// `identified_vertex`.
pub const IDENTIFIED_VERTEX: &str = "identified_vertex";
/// `identified_fragment`.
pub const IDENTIFIED_FRAGMENT: &str = "identified_fragment";
/// `identified_reflecting_fragment`.
pub const IDENTIFIED_REFLECTING_FRAGMENT: &str = "identified_reflecting_fragment";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `materials`.
pub const MATERIALS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `lights`.
pub const LIGHTS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 1 };
/// `base_colour_texture`.
pub const BASE_COLOUR_TEXTURE: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 0 };
/// `base_colour_sampler`.
pub const BASE_COLOUR_SAMPLER: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 1 };
/// `environment_texture`.
pub const ENVIRONMENT_TEXTURE: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 0 };
/// `environment_sampler`.
pub const ENVIRONMENT_SAMPLER: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/signature.wgsl`.
pub mod signature {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/signature.wgsl"), include_str!("../wgsl/shared/transparent_sums.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), include_str!("../wgsl/shared/material.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("signature"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/signature.wgsl"), first_line: 1, lines: 9 }, crate::SourcePart { file: Borrowed("wgsl/shared/transparent_sums.wgsl"), first_line: 10, lines: 48 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 58, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 74, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 88, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 99, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 111, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/material.wgsl"), first_line: 121, lines: 43 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 2, name: Borrowed("normal"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 3, name: Borrowed("uv"), format: wgpu::VertexFormat::Float32x2 }, crate::VertexInput { location: 4, name: Borrowed("colour"), format: wgpu::VertexFormat::Float32x4 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("materials"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(80) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_texture"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: true }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_sampler"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("signatures"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("samples"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("opaque_depth"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Material"), kind: crate::LayoutKind::Memory, size: 80, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("base_colour"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("uv_u"), offset: 16, size: 12 }, crate::FieldLayout { name: Borrowed("alpha_cutoff"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("uv_v"), offset: 32, size: 12 }, crate::FieldLayout { name: Borrowed("unlit"), offset: 44, size: 4 }, crate::FieldLayout { name: Borrowed("metallic"), offset: 48, size: 4 }, crate::FieldLayout { name: Borrowed("roughness"), offset: 52, size: 4 }, crate::FieldLayout { name: Borrowed("environment_level"), offset: 56, size: 4 }, crate::FieldLayout { name: Borrowed("environment_inset"), offset: 60, size: 4 }, crate::FieldLayout { name: Borrowed("emission"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("padding"), offset: 76, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[crate::Override { key: Borrowed("textured"), required: false }, ]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE).union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE), };
/// Names of the entry points.
pub mod entry {
/// `fragment`.
pub const FRAGMENT: &str = "fragment";
/// `vertex`.
pub const VERTEX: &str = "vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `materials`.
pub const MATERIALS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `base_colour_texture`.
pub const BASE_COLOUR_TEXTURE: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 0 };
/// `base_colour_sampler`.
pub const BASE_COLOUR_SAMPLER: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 1 };
/// `signatures`.
pub const SIGNATURES: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 0 };
/// `samples`.
pub const SAMPLES: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 1 };
/// `opaque_depth`.
pub const OPAQUE_DEPTH: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 2 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/signature_early.wgsl`.
pub mod signature_early {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/signature_early.wgsl"), include_str!("../wgsl/shared/transparent_sums.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), include_str!("../wgsl/shared/material.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("signature_early"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/signature_early.wgsl"), first_line: 1, lines: 8 }, crate::SourcePart { file: Borrowed("wgsl/shared/transparent_sums.wgsl"), first_line: 9, lines: 48 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 57, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 73, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 87, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 98, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 110, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/material.wgsl"), first_line: 120, lines: 43 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: true, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 2, name: Borrowed("normal"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 3, name: Borrowed("uv"), format: wgpu::VertexFormat::Float32x2 }, crate::VertexInput { location: 4, name: Borrowed("colour"), format: wgpu::VertexFormat::Float32x4 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("materials"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(80) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_texture"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: true }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_sampler"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("signatures"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("samples"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Material"), kind: crate::LayoutKind::Memory, size: 80, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("base_colour"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("uv_u"), offset: 16, size: 12 }, crate::FieldLayout { name: Borrowed("alpha_cutoff"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("uv_v"), offset: 32, size: 12 }, crate::FieldLayout { name: Borrowed("unlit"), offset: 44, size: 4 }, crate::FieldLayout { name: Borrowed("metallic"), offset: 48, size: 4 }, crate::FieldLayout { name: Borrowed("roughness"), offset: 52, size: 4 }, crate::FieldLayout { name: Borrowed("environment_level"), offset: 56, size: 4 }, crate::FieldLayout { name: Borrowed("environment_inset"), offset: 60, size: 4 }, crate::FieldLayout { name: Borrowed("emission"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("padding"), offset: 76, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[crate::Override { key: Borrowed("textured"), required: false }, ]),
immediate_size: 0,
features: wgpu::Features::empty().union(wgpu::Features::SHADER_EARLY_DEPTH_TEST), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE).union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE).union(wgpu::DownlevelFlags::MULTISAMPLED_SHADING), };
/// Names of the entry points.
pub mod entry {
/// `fragment_of_samples`.
pub const FRAGMENT_OF_SAMPLES: &str = "fragment_of_samples";
/// `vertex`.
pub const VERTEX: &str = "vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `materials`.
pub const MATERIALS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `base_colour_texture`.
pub const BASE_COLOUR_TEXTURE: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 0 };
/// `base_colour_sampler`.
pub const BASE_COLOUR_SAMPLER: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 1 };
/// `signatures`.
pub const SIGNATURES: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 0 };
/// `samples`.
pub const SAMPLES: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 1 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/signature_many.wgsl`.
pub mod signature_many {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/signature_many.wgsl"), include_str!("../wgsl/shared/transparent_sums.wgsl"), include_str!("../wgsl/shared/position.wgsl"), include_str!("../wgsl/shared/clip.wgsl"), include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/instance.wgsl"), include_str!("../wgsl/shared/material.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("signature_many"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/signature_many.wgsl"), first_line: 1, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/transparent_sums.wgsl"), first_line: 11, lines: 48 }, crate::SourcePart { file: Borrowed("wgsl/shared/position.wgsl"), first_line: 59, lines: 16 }, crate::SourcePart { file: Borrowed("wgsl/shared/clip.wgsl"), first_line: 75, lines: 14 }, crate::SourcePart { file: Borrowed("wgsl/shared/view.wgsl"), first_line: 89, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 100, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/instance.wgsl"), first_line: 112, lines: 10 }, crate::SourcePart { file: Borrowed("wgsl/shared/material.wgsl"), first_line: 122, lines: 43 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, crate::EntryPoint { name: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), workgroup_size: [0, 0, 0], forces_early_depth: false, vertex_inputs: Borrowed(&[crate::VertexInput { location: 0, name: Borrowed("local"), format: wgpu::VertexFormat::Float32x3 }, crate::VertexInput { location: 1, name: Borrowed("slot"), format: wgpu::VertexFormat::Uint32 }, crate::VertexInput { location: 2, name: Borrowed("normal"), format: wgpu::VertexFormat::Float32x4 }, crate::VertexInput { location: 3, name: Borrowed("uv"), format: wgpu::VertexFormat::Float32x2 }, crate::VertexInput { location: 4, name: Borrowed("colour"), format: wgpu::VertexFormat::Float32x4 }, ]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(96) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 1, name: Borrowed("materials"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX).union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(80) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, crate::BindingUse { entry_point: Borrowed("vertex"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::VERTEX), filters: false }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_texture"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: true }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: true }, ]),
}, crate::Binding { group: 2, name: Borrowed("base_colour_sampler"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("signatures"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("samples"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, crate::Binding { group: 3, name: Borrowed("opaque_depth"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: true }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("fragment_of_samples"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::FRAGMENT), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("Instance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("origin_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("material"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Material"), kind: crate::LayoutKind::Memory, size: 80, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("base_colour"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("uv_u"), offset: 16, size: 12 }, crate::FieldLayout { name: Borrowed("alpha_cutoff"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("uv_v"), offset: 32, size: 12 }, crate::FieldLayout { name: Borrowed("unlit"), offset: 44, size: 4 }, crate::FieldLayout { name: Borrowed("metallic"), offset: 48, size: 4 }, crate::FieldLayout { name: Borrowed("roughness"), offset: 52, size: 4 }, crate::FieldLayout { name: Borrowed("environment_level"), offset: 56, size: 4 }, crate::FieldLayout { name: Borrowed("environment_inset"), offset: 60, size: 4 }, crate::FieldLayout { name: Borrowed("emission"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("padding"), offset: 76, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("View"), kind: crate::LayoutKind::Memory, size: 96, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, ]),
tail: None }, ]),
overrides: Borrowed(&[crate::Override { key: Borrowed("textured"), required: false }, ]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE).union(wgpu::DownlevelFlags::VERTEX_STORAGE).union(wgpu::DownlevelFlags::FRAGMENT_STORAGE).union(wgpu::DownlevelFlags::MULTISAMPLED_SHADING), };
/// Names of the entry points.
pub mod entry {
/// `fragment_of_samples`.
pub const FRAGMENT_OF_SAMPLES: &str = "fragment_of_samples";
/// `vertex`.
pub const VERTEX: &str = "vertex";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `materials`.
pub const MATERIALS: crate::BindingPlace = crate::BindingPlace { group: 1, binding: 0 };
/// `base_colour_texture`.
pub const BASE_COLOUR_TEXTURE: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 0 };
/// `base_colour_sampler`.
pub const BASE_COLOUR_SAMPLER: crate::BindingPlace = crate::BindingPlace { group: 2, binding: 1 };
/// `signatures`.
pub const SIGNATURES: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 0 };
/// `samples`.
pub const SAMPLES: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 1 };
/// `opaque_depth`.
pub const OPAQUE_DEPTH: crate::BindingPlace = crate::BindingPlace { group: 3, binding: 2 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
}
}
/// `wgsl/test_slots_many.wgsl`.
pub mod test_slots_many {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/test_slots_many.wgsl"), include_str!("../wgsl/shared/test_slots.wgsl"), include_str!("../wgsl/shared/slot_state_of.wgsl"), include_str!("../wgsl/shared/look_together.wgsl"), include_str!("../wgsl/shared/box_test.wgsl"), include_str!("../wgsl/shared/judged.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/seen_shape.wgsl"), include_str!("../wgsl/shared/look_at_parts.wgsl"), include_str!("../wgsl/shared/part_box.wgsl"), include_str!("../wgsl/shared/screen_size.wgsl"), include_str!("../wgsl/shared/slot_states.wgsl"), include_str!("../wgsl/shared/depth_many.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("test_slots_many"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/test_slots_many.wgsl"), first_line: 1, lines: 3 }, crate::SourcePart { file: Borrowed("wgsl/shared/test_slots.wgsl"), first_line: 4, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_state_of.wgsl"), first_line: 32, lines: 32 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_together.wgsl"), first_line: 64, lines: 20 }, crate::SourcePart { file: Borrowed("wgsl/shared/box_test.wgsl"), first_line: 84, lines: 191 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged.wgsl"), first_line: 275, lines: 126 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 401, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 419, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 447, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 459, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/seen_shape.wgsl"), first_line: 481, lines: 243 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_at_parts.wgsl"), first_line: 724, lines: 37 }, crate::SourcePart { file: Borrowed("wgsl/shared/part_box.wgsl"), first_line: 761, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/screen_size.wgsl"), first_line: 789, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_states.wgsl"), first_line: 800, lines: 6 }, crate::SourcePart { file: Borrowed("wgsl/shared/depth_many.wgsl"), first_line: 806, lines: 11 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(128) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("first"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("states"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("rest"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("depth"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: true }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("drawn"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("part_boxes"), entry: wgpu::BindGroupLayoutEntry { binding: 9, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(8) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("JudgedView"), kind: crate::LayoutKind::Memory, size: 128, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 96, size: 4 }, crate::FieldLayout { name: Borrowed("depth_step"), offset: 100, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 104, size: 4 }, crate::FieldLayout { name: Borrowed("flags"), offset: 108, size: 4 }, crate::FieldLayout { name: Borrowed("shift"), offset: 112, size: 4 }, crate::FieldLayout { name: Borrowed("drift_x"), offset: 116, size: 4 }, crate::FieldLayout { name: Borrowed("drift_y"), offset: 120, size: 4 }, crate::FieldLayout { name: Borrowed("drift_w"), offset: 124, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `test_slots`.
pub const TEST_SLOTS: &str = "test_slots";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `first`.
pub const FIRST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `states`.
pub const STATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `rest`.
pub const REST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `depth`.
pub const DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
/// `drawn`.
pub const DRAWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
/// `part_boxes`.
pub const PART_BOXES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 9 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `test_slots`.
pub const TEST_SLOTS: [u32; 3] = [64, 1, 1];
}
}
/// `wgsl/test_slots_one.wgsl`.
pub mod test_slots_one {
#[allow(unused_imports, reason = "which of them depends on the job")]
use std::{borrow::Cow::Borrowed, num::{NonZeroU32, NonZeroU64}};
/// The text for wgpu, imports included.
pub const SOURCE: &str = concat!(include_str!("../wgsl/test_slots_one.wgsl"), include_str!("../wgsl/shared/test_slots.wgsl"), include_str!("../wgsl/shared/slot_state_of.wgsl"), include_str!("../wgsl/shared/look_together.wgsl"), include_str!("../wgsl/shared/box_test.wgsl"), include_str!("../wgsl/shared/judged.wgsl"), include_str!("../wgsl/shared/judged_instance.wgsl"), include_str!("../wgsl/shared/relative_box.wgsl"), include_str!("../wgsl/shared/eye_relative.wgsl"), include_str!("../wgsl/shared/pyramid.wgsl"), include_str!("../wgsl/shared/seen_shape.wgsl"), include_str!("../wgsl/shared/look_at_parts.wgsl"), include_str!("../wgsl/shared/part_box.wgsl"), include_str!("../wgsl/shared/screen_size.wgsl"), include_str!("../wgsl/shared/slot_states.wgsl"), include_str!("../wgsl/shared/depth_one.wgsl"), );
/// The job.
pub static JOB: crate::Job = crate::Job {
name: Borrowed("test_slots_one"), source: Borrowed(SOURCE),
parts: Borrowed(&[crate::SourcePart { file: Borrowed("wgsl/test_slots_one.wgsl"), first_line: 1, lines: 3 }, crate::SourcePart { file: Borrowed("wgsl/shared/test_slots.wgsl"), first_line: 4, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_state_of.wgsl"), first_line: 32, lines: 32 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_together.wgsl"), first_line: 64, lines: 20 }, crate::SourcePart { file: Borrowed("wgsl/shared/box_test.wgsl"), first_line: 84, lines: 191 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged.wgsl"), first_line: 275, lines: 126 }, crate::SourcePart { file: Borrowed("wgsl/shared/judged_instance.wgsl"), first_line: 401, lines: 18 }, crate::SourcePart { file: Borrowed("wgsl/shared/relative_box.wgsl"), first_line: 419, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/eye_relative.wgsl"), first_line: 447, lines: 12 }, crate::SourcePart { file: Borrowed("wgsl/shared/pyramid.wgsl"), first_line: 459, lines: 22 }, crate::SourcePart { file: Borrowed("wgsl/shared/seen_shape.wgsl"), first_line: 481, lines: 243 }, crate::SourcePart { file: Borrowed("wgsl/shared/look_at_parts.wgsl"), first_line: 724, lines: 37 }, crate::SourcePart { file: Borrowed("wgsl/shared/part_box.wgsl"), first_line: 761, lines: 28 }, crate::SourcePart { file: Borrowed("wgsl/shared/screen_size.wgsl"), first_line: 789, lines: 11 }, crate::SourcePart { file: Borrowed("wgsl/shared/slot_states.wgsl"), first_line: 800, lines: 6 }, crate::SourcePart { file: Borrowed("wgsl/shared/depth_one.wgsl"), first_line: 806, lines: 7 }, ]),
entry_points: Borrowed(&[crate::EntryPoint { name: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), workgroup_size: [64, 1, 1], forces_early_depth: false, vertex_inputs: Borrowed(&[]),
}, ]),
bindings: Borrowed(&[crate::Binding { group: 0, name: Borrowed("view"), entry: wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(128) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("instances"), entry: wgpu::BindGroupLayoutEntry { binding: 1, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(64) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("first"), entry: wgpu::BindGroupLayoutEntry { binding: 2, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("states"), entry: wgpu::BindGroupLayoutEntry { binding: 3, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("rest"), entry: wgpu::BindGroupLayoutEntry { binding: 4, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("pyramid"), entry: wgpu::BindGroupLayoutEntry { binding: 5, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(288) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("texels"), entry: wgpu::BindGroupLayoutEntry { binding: 6, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("depth"), entry: wgpu::BindGroupLayoutEntry { binding: 7, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Texture { sample_type: wgpu::TextureSampleType::Float { filterable: false }, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("drawn"), entry: wgpu::BindGroupLayoutEntry { binding: 8, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: false }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(4) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, crate::Binding { group: 0, name: Borrowed("part_boxes"), entry: wgpu::BindGroupLayoutEntry { binding: 9, visibility: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), ty: wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(8) }, count: NonZeroU32::new(0) }, uses: Borrowed(&[crate::BindingUse { entry_point: Borrowed("test_slots"), stage: wgpu::ShaderStages::empty().union(wgpu::ShaderStages::COMPUTE), filters: false }, ]),
}, ]),
structs: Borrowed(&[crate::StructLayout { name: Borrowed("JudgedInstance"), kind: crate::LayoutKind::Memory, size: 64, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("row_x"), offset: 0, size: 16 }, crate::FieldLayout { name: Borrowed("row_y"), offset: 16, size: 16 }, crate::FieldLayout { name: Borrowed("row_z"), offset: 32, size: 16 }, crate::FieldLayout { name: Borrowed("centre_low"), offset: 48, size: 12 }, crate::FieldLayout { name: Borrowed("traits"), offset: 60, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("JudgedView"), kind: crate::LayoutKind::Memory, size: 128, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("clip_from_relative"), offset: 0, size: 64 }, crate::FieldLayout { name: Borrowed("eye_high"), offset: 64, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_wide"), offset: 76, size: 4 }, crate::FieldLayout { name: Borrowed("eye_low"), offset: 80, size: 12 }, crate::FieldLayout { name: Borrowed("pixels_high"), offset: 92, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 96, size: 4 }, crate::FieldLayout { name: Borrowed("depth_step"), offset: 100, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 104, size: 4 }, crate::FieldLayout { name: Borrowed("flags"), offset: 108, size: 4 }, crate::FieldLayout { name: Borrowed("shift"), offset: 112, size: 4 }, crate::FieldLayout { name: Borrowed("drift_x"), offset: 116, size: 4 }, crate::FieldLayout { name: Borrowed("drift_y"), offset: 120, size: 4 }, crate::FieldLayout { name: Borrowed("drift_w"), offset: 124, size: 4 }, ]),
tail: None }, crate::StructLayout { name: Borrowed("Pyramid"), kind: crate::LayoutKind::Memory, size: 288, align: 16, fields: Borrowed(&[crate::FieldLayout { name: Borrowed("width"), offset: 0, size: 4 }, crate::FieldLayout { name: Borrowed("height"), offset: 4, size: 4 }, crate::FieldLayout { name: Borrowed("samples"), offset: 8, size: 4 }, crate::FieldLayout { name: Borrowed("towards"), offset: 12, size: 4 }, crate::FieldLayout { name: Borrowed("count"), offset: 16, size: 4 }, crate::FieldLayout { name: Borrowed("padding_a"), offset: 20, size: 4 }, crate::FieldLayout { name: Borrowed("padding_b"), offset: 24, size: 4 }, crate::FieldLayout { name: Borrowed("padding_c"), offset: 28, size: 4 }, crate::FieldLayout { name: Borrowed("levels"), offset: 32, size: 256 }, ]),
tail: None }, ]),
overrides: Borrowed(&[]),
immediate_size: 0,
features: wgpu::Features::empty(), downlevel: wgpu::DownlevelFlags::empty().union(wgpu::DownlevelFlags::COMPUTE_SHADERS), };
/// Names of the entry points.
pub mod entry {
/// `test_slots`.
pub const TEST_SLOTS: &str = "test_slots";
}
/// Places of the variables in use.
pub mod binding {
/// `view`.
pub const VIEW: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 0 };
/// `instances`.
pub const INSTANCES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 1 };
/// `first`.
pub const FIRST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 2 };
/// `states`.
pub const STATES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 3 };
/// `rest`.
pub const REST: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 4 };
/// `pyramid`.
pub const PYRAMID: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 5 };
/// `texels`.
pub const TEXELS: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 6 };
/// `depth`.
pub const DEPTH: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 7 };
/// `drawn`.
pub const DRAWN: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 8 };
/// `part_boxes`.
pub const PART_BOXES: crate::BindingPlace = crate::BindingPlace { group: 0, binding: 9 };
}
/// Workgroup sizes of the compute entry points.
pub mod workgroup {
/// Of `test_slots`.
pub const TEST_SLOTS: [u32; 3] = [64, 1, 1];
}
}
