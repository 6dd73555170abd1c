//! What reflection says of one job that uses every kind of resource, against what a reader of its WGSL would write.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::num::NonZeroU64;

use antumbra_shaders::{Job, LayoutKind, SharedSource};
use wgpu::{
    BindingType, BufferBindingType, DownlevelFlags, Features, SamplerBindingType, ShaderStages,
    StorageTextureAccess, TextureFormat, TextureSampleType, TextureViewDimension, VertexFormat,
};

fn everything() -> Job {
    let shared = [SharedSource {
        name: "frame",
        text: include_str!("wgsl/frame.wgsl"),
    }];
    Job::from_wgsl_with("everything", include_str!("wgsl/everything.wgsl"), &shared).unwrap()
}

fn buffer(ty: BufferBindingType, size: u64) -> BindingType {
    BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: NonZeroU64::new(size),
    }
}

fn texture(sample_type: TextureSampleType, view_dimension: TextureViewDimension) -> BindingType {
    BindingType::Texture {
        sample_type,
        view_dimension,
        multisampled: false,
    }
}

#[test]
fn bindings_have_their_types_and_the_stages_that_use_them() {
    use BufferBindingType::{Storage, Uniform};
    let job = everything();
    let (vertex, fragment, compute) = (
        ShaderStages::VERTEX,
        ShaderStages::FRAGMENT,
        ShaderStages::COMPUTE,
    );
    let plane = TextureViewDimension::D2;
    let expected = [
        ("frame", 0, 3, fragment | compute, buffer(Uniform, 4)),
        (
            "read_cloud",
            1,
            0,
            vertex | compute,
            buffer(Storage { read_only: true }, 48),
        ),
        (
            "cloud",
            1,
            1,
            compute,
            buffer(Storage { read_only: false }, 64),
        ),
        (
            "picture",
            1,
            2,
            fragment,
            texture(TextureSampleType::Float { filterable: true }, plane),
        ),
        (
            "picture_sampler",
            1,
            3,
            fragment,
            BindingType::Sampler(SamplerBindingType::Filtering),
        ),
        (
            "shadow",
            1,
            4,
            fragment,
            texture(TextureSampleType::Depth, TextureViewDimension::D2Array),
        ),
        (
            "shadow_sampler",
            1,
            5,
            fragment,
            BindingType::Sampler(SamplerBindingType::Comparison),
        ),
        (
            "loaded",
            1,
            6,
            fragment,
            BindingType::Texture {
                sample_type: TextureSampleType::Float { filterable: false },
                view_dimension: plane,
                multisampled: true,
            },
        ),
        (
            "target_image",
            1,
            7,
            compute,
            BindingType::StorageTexture {
                access: StorageTextureAccess::WriteOnly,
                format: TextureFormat::Rgba16Float,
                view_dimension: plane,
            },
        ),
        (
            "ids",
            1,
            8,
            fragment,
            texture(TextureSampleType::Uint, plane),
        ),
        (
            "both",
            1,
            9,
            vertex | fragment,
            texture(TextureSampleType::Float { filterable: true }, plane),
        ),
    ];
    let found: Vec<_> = job
        .bindings
        .iter()
        .map(|b| {
            (
                b.name.as_ref(),
                b.group,
                b.entry.binding,
                b.entry.visibility,
                b.entry.ty,
            )
        })
        .collect();
    assert_eq!(found, expected);
    assert_eq!(job.group_count(), 2);
    assert_eq!(job.layout_entries(0).len(), 1);
    assert!(job.layout_entries(5).is_empty());
}

#[test]
fn a_float_texture_that_is_only_loaded_is_not_filterable() {
    let ty = antumbra_shaders::jobs::count_compare::JOB
        .binding("occluder_depth")
        .unwrap()
        .entry
        .ty;
    let plane = TextureViewDimension::D2;
    assert_eq!(
        ty,
        texture(TextureSampleType::Float { filterable: false }, plane)
    );
}

#[test]
fn structs_have_wgsl_offsets_and_vertex_inputs_packed_ones() {
    let job = everything();
    let names: Vec<_> = job.structs.iter().map(|s| s.name.as_ref()).collect();
    assert_eq!(names, ["Cloud", "Frame", "Input", "Moved", "Particle"]);

    let fields = |name: &str| -> Vec<(String, u32, u32)> {
        let layout = job.struct_layout(name).unwrap();
        let fields = layout.fields.iter();
        fields
            .map(|f| (f.name.to_string(), f.offset, f.size))
            .collect()
    };
    let named = |list: &[(&str, u32, u32)]| -> Vec<(String, u32, u32)> {
        list.iter()
            .map(|(n, o, s)| ((*n).to_owned(), *o, *s))
            .collect()
    };
    assert_eq!(
        fields("Particle"),
        named(&[("position", 0, 12), ("age", 12, 4), ("spins", 16, 32)])
    );
    let particle = job.struct_layout("Particle").unwrap();
    assert_eq!(
        (particle.size, particle.align, particle.kind),
        (48, 16, LayoutKind::Memory)
    );

    let cloud = job.struct_layout("Cloud").unwrap();
    assert_eq!(fields("Cloud"), named(&[("count", 0, 4)]));
    let tail = cloud.tail.as_ref().unwrap();
    assert_eq!((cloud.size, tail.offset, tail.stride), (16, 16, 48));

    let input = job.struct_layout("Input").unwrap();
    assert_eq!((input.size, input.kind), (36, LayoutKind::Vertex));
    assert_eq!(
        fields("Input"),
        named(&[("position", 0, 12), ("uv", 12, 8), ("weights", 20, 16)])
    );
}

#[test]
fn entry_points_overrides_and_immediates() {
    let job = everything();
    let compute = job.entry_point("compute").unwrap();
    assert_eq!(
        (compute.stage, compute.workgroup_size),
        (ShaderStages::COMPUTE, [0, 2, 1])
    );
    let vertex = job.entry_point("vertex").unwrap();
    let inputs: Vec<_> = vertex
        .vertex_inputs
        .iter()
        .map(|i| (i.location, i.name.as_ref(), i.format))
        .collect();
    assert_eq!(
        inputs,
        [
            (0, "position", VertexFormat::Float32x3),
            (1, "uv", VertexFormat::Float32x2),
            (2, "weights", VertexFormat::Uint32x4),
            (5, "extra", VertexFormat::Sint32),
        ]
    );
    let overrides: Vec<_> = job
        .overrides
        .iter()
        .map(|o| (o.key.as_ref(), o.required))
        .collect();
    assert_eq!(overrides, [("wide", false), ("7", true)]);
    assert_eq!(job.immediate_size, 8);
}

#[test]
fn requirements_are_the_smallest_that_validate() {
    let job = everything();
    assert_eq!(job.features, Features::IMMEDIATES | Features::SHADER_F16);
    assert_eq!(
        job.downlevel,
        DownlevelFlags::COMPUTE_SHADERS | DownlevelFlags::VERTEX_STORAGE
    );

    let of = |text: &str| Job::from_wgsl_with("probe", text, &[]).unwrap();
    let early = of("@fragment @early_depth_test(force) fn f() {}");
    assert_eq!(early.features, Features::SHADER_EARLY_DEPTH_TEST);
    assert!(early.entry_points[0].forces_early_depth);
    let views = of(
        "@vertex fn v(@builtin(view_index) eye: u32) -> @builtin(position) vec4<f32> { return vec4(f32(eye)); }",
    );
    assert_eq!(views.features, Features::MULTIVIEW);
    let lanes = of("@compute @workgroup_size(1) fn c() { _ = subgroupAdd(1u); }");
    assert_eq!(lanes.features, Features::SUBGROUP);
    let wide = of(
        "@group(0) @binding(0) var<storage, read_write> a: atomic<u64>;
        @compute @workgroup_size(1) fn c() { atomicMax(&a, 1lu); }",
    );
    assert_eq!(
        wide.features,
        Features::SHADER_INT64 | Features::SHADER_INT64_ATOMIC_MIN_MAX
    );
    let writes = of(
        "@group(0) @binding(0) var<storage, read_write> a: atomic<u32>;
        @fragment fn f() { atomicAdd(&a, 1u); }",
    );
    assert_eq!(writes.features, Features::empty());
    assert_eq!(
        writes.downlevel,
        DownlevelFlags::FRAGMENT_STORAGE | DownlevelFlags::FRAGMENT_WRITABLE_STORAGE
    );
    let vertex_writes = of(
        "@group(0) @binding(0) var<storage, read_write> a: atomic<u32>;
        @vertex fn v() -> @builtin(position) vec4<f32> { atomicAdd(&a, 1u); return vec4(0.0); }",
    );
    assert_eq!(vertex_writes.features, Features::VERTEX_WRITABLE_STORAGE);
}

#[test]
fn built_in_jobs_are_what_reflecting_their_text_again_gives() {
    assert!(!antumbra_shaders::jobs::ALL.is_empty());
    for job in antumbra_shaders::jobs::ALL {
        // The joined text holds the import lines of every file in it: they are done, and now comments.
        let plain = job.source.replace("//!", "// ");
        let mut again = Job::from_wgsl_with(&job.name, &plain, &[]).unwrap();
        again.source = job.source.clone();
        again.parts = job.parts.clone();
        assert_eq!(again, **job);
    }
}
