//! Layouts of pipelines whose entry points come from several jobs.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_shaders::{BindGroupError, BindGroups, Job, jobs};
use wgpu::{BindingType, ShaderStages, TextureSampleType};

fn job(name: &str, text: &str) -> Job {
    Job::from_wgsl_with(name, text, &[]).unwrap()
}

fn vertex() -> Job {
    job(
        "vertex",
        "@group(0) @binding(0) var<uniform> view: mat4x4<f32>;
        @group(0) @binding(2) var image: texture_2d<f32>;
        @vertex fn main() -> @builtin(position) vec4<f32> { return view * textureLoad(image, vec2<i32>(0), 0); }",
    )
}

fn fragment(view: &str) -> Job {
    job(
        "fragment",
        &format!(
            "@group(0) @binding(0) var<uniform> eye: {view};
            @group(0) @binding(2) var image: texture_2d<f32>;
            @group(2) @binding(1) var by: sampler;
            @fragment fn plain() -> @location(0) vec4<f32> {{ _ = eye; return vec4<f32>(0.0); }}
            @fragment fn main() -> @location(0) vec4<f32> {{ return textureSample(image, by, vec2<f32>(eye[0].x)); }}"
        ),
    )
}

#[test]
fn visibility_sizes_and_filtering_unite() {
    let (vertex, fragment) = (vertex(), fragment("array<vec4<f32>, 8>"));
    let groups = BindGroups::of(&[vertex.entry("main"), fragment.entry("main")]).unwrap();
    assert_eq!(groups.len(), 3);
    assert!(groups.entries(1).is_empty() && groups.entries(9).is_empty());
    let both = ShaderStages::VERTEX_FRAGMENT;
    assert_eq!(groups.entries(0)[0].visibility, both);
    let BindingType::Buffer {
        min_binding_size, ..
    } = groups.entries(0)[0].ty
    else {
        panic!("not a buffer");
    };
    assert_eq!(min_binding_size.unwrap().get(), 128);
    let filterable = |groups: &BindGroups| match groups.entries(0)[1].ty {
        BindingType::Texture {
            sample_type: TextureSampleType::Float { filterable },
            ..
        } => filterable,
        other => panic!("{other:?}"),
    };
    assert_eq!(groups.entries(0)[1].visibility, both);
    assert!(filterable(&groups));

    let plain = BindGroups::of(&[fragment.entry("plain"), vertex.entry("main")]).unwrap();
    assert_eq!(plain.len(), 1);
    assert_eq!(plain.entries(0)[1].visibility, ShaderStages::VERTEX);
    assert!(!filterable(&plain));
    assert_eq!(BindGroups::of_jobs(&[&vertex, &fragment]).unwrap(), groups);
}

#[test]
fn conflicts_name_both_variables() {
    let other = job(
        "other",
        "@group(0) @binding(0) var<storage, read> list: array<u32>;
        @fragment fn main() { _ = list[0]; }",
    );
    let error = BindGroups::of_jobs(&[&vertex(), &other]).unwrap_err();
    let text = error.to_string();
    assert!(matches!(
        error,
        BindGroupError::Conflict {
            group: 0,
            binding: 0,
            ..
        }
    ));
    for word in ["view", "list", "vertex", "other", "Uniform", "Storage"] {
        assert!(text.contains(word), "{text}");
    }
    let error = BindGroups::of(&[other.entry("mian")]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "job `other` has no entry point `mian`; it has: main"
    );
}

#[test]
fn dynamic_offsets_are_for_buffers() {
    let vertex = vertex();
    let groups = BindGroups::of(&[vertex.entry("main")]).unwrap();
    let dynamic = groups.clone().dynamic_offset(0, 0).unwrap();
    assert!(matches!(
        dynamic.entries(0)[0].ty,
        BindingType::Buffer {
            has_dynamic_offset: true,
            ..
        }
    ));
    assert!(groups.clone().dynamic_offset(0, 2).is_err());
    assert!(groups.dynamic_offset(7, 0).is_err());
}

#[test]
fn an_entry_point_brings_only_what_it_uses() {
    use jobs::identity::{JOB, entry};
    let plain = BindGroups::of(&[JOB.entry(entry::VERTEX), JOB.entry(entry::FRAGMENT)]).unwrap();
    let masked = BindGroups::of(&[
        JOB.entry(entry::MASKED_VERTEX),
        JOB.entry(entry::MASKED_FRAGMENT),
    ])
    .unwrap();
    assert_eq!((plain.len(), masked.len()), (1, 3));
}
