//! Every built-in job through naga's writers, for each language it claims, and through wgpu's own checks.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_shaders::{BindGroups, EntryPoint, Job, Language, jobs, module};
use naga::{
    back::{glsl, hlsl, msl, spv},
    proc::BoundsCheckPolicies,
    valid::{Capabilities, ModuleInfo, ValidationFlags, Validator},
};

fn parsed(job: &Job) -> (naga::Module, ModuleInfo) {
    let module = naga::front::wgsl::parse_str(&job.source).unwrap();
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .unwrap();
    (module, info)
}

/// Writes one entry point, its overrides at their defaults, as wgpu's backends do.
fn translate(job: &Job, language: Language) -> Result<(), String> {
    let (module, info) = parsed(job);
    let supported = match language {
        Language::SpirV => spv::supported_capabilities(),
        Language::Glsl => glsl::supported_capabilities(),
        Language::Msl => msl::supported_capabilities(),
        Language::Hlsl => hlsl::supported_capabilities(),
    };
    let needed = wgpu_naga_bridge::features_to_naga_capabilities(job.features, job.downlevel);
    if !supported.contains(needed) {
        return Err(format!(
            "the writer cannot express {:?}",
            needed - supported
        ));
    }
    for entry in &module.entry_points {
        let stage = entry.stage;
        let (module, info) = naga::back::pipeline_constants::process_overrides(
            &module,
            &info,
            Some((stage, &entry.name)),
            &Default::default(),
        )
        .map_err(|e| e.to_string())?;
        match language {
            Language::SpirV => {
                let options = spv::PipelineOptions {
                    shader_stage: stage,
                    entry_point: entry.name.clone(),
                };
                spv::write_vec(&module, &info, &spv::Options::default(), Some(&options))
                    .map_err(|e| format!("{}: {e}", entry.name))?;
            }
            Language::Glsl => {
                for version in [glsl::Version::new_gles(310), glsl::Version::Desktop(430)] {
                    let options = glsl::Options {
                        version,
                        ..Default::default()
                    };
                    let entry_point = entry.name.clone();
                    let pipeline = glsl::PipelineOptions {
                        shader_stage: stage,
                        entry_point,
                        multiview: None,
                    };
                    let mut text = String::new();
                    glsl::Writer::new(
                        &mut text,
                        &module,
                        &info,
                        &options,
                        &pipeline,
                        BoundsCheckPolicies::default(),
                    )
                    .and_then(|mut writer| writer.write())
                    .map_err(|e| format!("{} as {version:?}: {e}", entry.name))?;
                }
            }
            Language::Msl => {
                let options = msl::Options {
                    fake_missing_bindings: true,
                    lang_version: (2, 1),
                    ..Default::default()
                };
                let entry_point = Some((stage, entry.name.clone()));
                let pipeline = msl::PipelineOptions {
                    entry_point,
                    ..Default::default()
                };
                let (_, written) = msl::write_string(&module, &info, &options, &pipeline)
                    .map_err(|e| format!("{}: {e}", entry.name))?;
                for name in written.entry_point_names {
                    name.map_err(|e| format!("{}: {e}", entry.name))?;
                }
            }
            Language::Hlsl => {
                let options = hlsl::Options {
                    fake_missing_bindings: true,
                    ..Default::default()
                };
                let pipeline = hlsl::PipelineOptions {
                    entry_point: Some((stage, entry.name.clone())),
                };
                let mut text = String::new();
                let written = hlsl::Writer::new(&mut text, &options, &pipeline)
                    .write(&module, &info, None)
                    .map_err(|e| format!("{}: {e}", entry.name))?;
                for name in written.entry_point_names {
                    name.map_err(|e| format!("{}: {e}", entry.name))?;
                }
            }
        }
    }
    Ok(())
}

#[test]
fn every_job_translates_to_the_languages_it_claims() {
    let mut failed = Vec::new();
    for job in jobs::ALL {
        for language in job.languages() {
            if let Err(error) = translate(job, *language) {
                failed.push(format!("{} to {language:?}: {error}", job.name));
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn claims_shrink_with_what_is_asked() {
    use Language::{Glsl, Hlsl, Msl, SpirV};
    assert_eq!(jobs::depth::JOB.languages(), [SpirV, Glsl, Msl, Hlsl]);
    assert_eq!(jobs::count_atomic::JOB.languages(), [SpirV, Glsl]);
    for language in [Hlsl, Msl] {
        assert!(translate(&jobs::count_atomic::JOB, language).is_err());
    }
}

#[test]
fn a_job_that_gl_cannot_express_is_found() {
    let job = Job::from_wgsl(
        "load_depth",
        "@group(0) @binding(0) var depth: texture_depth_2d;
        @fragment fn main() -> @location(0) vec4<f32> { return vec4<f32>(textureLoad(depth, vec2<i32>(0), 0)); }",
    )
    .unwrap();
    assert!(job.languages().contains(&Language::Glsl));
    let error = translate(&job, Language::Glsl).unwrap_err();
    assert!(error.contains("depth"), "{error}");
    translate(&job, Language::SpirV).unwrap();
}

/// wgpu's validation without a driver. Its answer to a pipeline includes the check of our layouts against the shader.
fn noop_device() -> wgpu::Device {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::NOOP;
    descriptor.backend_options.noop.enable = true;
    let instance = wgpu::Instance::new(descriptor);
    let adapter = pollster::block_on(instance.request_adapter(&Default::default())).unwrap();
    // The noop adapter supports no format by itself; without this feature wgpu goes by what every device guarantees.
    let left_out = wgpu::Features::all_experimental_mask()
        | wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES;
    let (device, _) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
        required_features: adapter.features() - left_out,
        required_limits: adapter.limits(),
        ..Default::default()
    }))
    .unwrap();
    device
}

#[test]
fn wgpu_accepts_every_job_and_its_reflected_layouts() {
    let device = noop_device();
    for job in jobs::ALL {
        let label = job.name.as_ref();
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let shader = module(&device, job);
        for entry in job
            .entry_points
            .iter()
            .filter(|e| e.stage == wgpu::ShaderStages::COMPUTE)
        {
            let groups = BindGroups::of(&[job.entry(&entry.name)]).unwrap();
            let layouts = groups.bind_group_layouts(&device, label);
            let layout = groups.pipeline_layout(&device, label, &layouts);
            let _ = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(label),
                layout: Some(&layout),
                module: &shader,
                entry_point: Some(&entry.name),
                compilation_options: Default::default(),
                cache: None,
            });
        }
        for entry in job
            .entry_points
            .iter()
            .filter(|e| e.stage == wgpu::ShaderStages::VERTEX)
        {
            let fragment = entry.name.replace("vertex", "fragment");
            let of_samples = format!("{fragment}_of_samples");
            let (once, many) = (job.entry_point(&fragment), job.entry_point(&of_samples));
            // Jobs for several samples alone have no other.
            if once.is_some() || many.is_none() {
                render_pipeline(&device, job, &shader, entry, once, 1);
            }
            if many.is_some() {
                render_pipeline(&device, job, &shader, entry, many, 4);
            }
        }
        if let Some(error) = pollster::block_on(scope.pop()) {
            panic!("{label}: {error}");
        }
    }
}

/// The colour targets a fragment entry point writes, in formats that every device renders to.
fn targets(job: &Job, name: &str) -> Vec<Option<wgpu::ColorTargetState>> {
    let (module, _) = parsed(job);
    let entry = module.entry_points.iter().find(|e| e.name == name).unwrap();
    let Some(result) = &entry.function.result else {
        return Vec::new();
    };
    let outputs = match &module.types[result.ty].inner {
        naga::TypeInner::Struct { members, .. } => {
            let located = |member: &&naga::StructMember| {
                matches!(member.binding, Some(naga::Binding::Location { .. }))
            };
            members
                .iter()
                .filter(located)
                .map(|member| member.ty)
                .collect()
        }
        _ => vec![result.ty],
    };
    let format = |output| match module.types[output].inner.scalar_kind() {
        Some(naga::ScalarKind::Float) => wgpu::TextureFormat::Rgba8Unorm,
        Some(naga::ScalarKind::Uint) => wgpu::TextureFormat::Rg16Uint,
        other => panic!("{name}: an output of {other:?}, extend this test"),
    };
    outputs
        .into_iter()
        .map(|output| Some(format(output).into()))
        .collect()
}

/// A pipeline of a vertex entry point and a fragment one, if there is one, from the reflected layouts and attributes, one buffer an attribute.
fn render_pipeline(
    device: &wgpu::Device,
    job: &Job,
    shader: &wgpu::ShaderModule,
    entry: &EntryPoint,
    partner: Option<&EntryPoint>,
    samples: u32,
) {
    let label = job.name.as_ref();
    let partner = partner.map(|found| found.name.as_ref());
    let mut parts = vec![job.entry(&entry.name)];
    parts.extend(partner.map(|name| job.entry(name)));
    let groups = BindGroups::of(&parts).unwrap();
    let layouts = groups.bind_group_layouts(device, label);
    let layout = groups.pipeline_layout(device, label, &layouts);
    let attributes: Vec<[wgpu::VertexAttribute; 1]> = entry
        .vertex_inputs
        .iter()
        .map(|input| {
            let (format, shader_location) = (input.format, input.location);
            [wgpu::VertexAttribute {
                format,
                offset: 0,
                shader_location,
            }]
        })
        .collect();
    let buffers: Vec<Option<wgpu::VertexBufferLayout<'_>>> = attributes
        .iter()
        .map(|attributes| {
            Some(wgpu::VertexBufferLayout {
                array_stride: attributes[0].format.size(),
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes,
            })
        })
        .collect();
    let targets = partner.map(|name| targets(job, name)).unwrap_or_default();
    let _ = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some(&entry.name),
            compilation_options: Default::default(),
            buffers: &buffers,
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState {
            count: samples,
            ..Default::default()
        },
        fragment: partner.map(|name| wgpu::FragmentState {
            module: shader,
            entry_point: Some(name),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    });
}
