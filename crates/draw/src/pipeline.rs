//! Render pipelines, created only for the pipeline classes that a scene has.

use antumbra_cull::{Alpha, DEPTH_FORMAT, Gpu, IDENTITY_FORMAT, PipelineClass};
use antumbra_scene::Topology as Primitive;
use antumbra_shaders::Job;
use antumbra_shaders::jobs::{
    count_atomic, count_compare, count_compare_many, depth, identity, patch_compare,
    patch_compare_many, patch_early, sample_identity, shaded, signature, signature_early,
    signature_many,
};

use crate::mesh::{ATTRIBUTE_LAYOUT, POSITION_LAYOUT, SLOT_LAYOUT, SLOT_PATCH_LAYOUT};

/// The format of [`PipelineKind::SampleIdentity`].
pub const SAMPLE_IDENTITY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// The bind group of the environment in the shaded pass.
pub(crate) const ENVIRONMENT_GROUP: u32 = 3;

/// What the pipelines of a pass test and write.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PipelineKind {
    /// Writes depth.
    Depth,
    /// Tests depth and writes nothing: the geometry of occlusion queries.
    Query,
    /// Tests depth and counts the fragments that pass, by slot.
    CountAtomic,
    /// Compares with a depth texture in the shader and counts the fragments that pass, by slot.
    CountCompare,
    /// Writes depth and entity ids.
    Identity,
    /// Writes depth and entity ids of one of a pixel's samples, as floats that can be resolved ([`SAMPLE_IDENTITY_FORMAT`]): the bytes of slot + 1.
    SampleIdentity {
        /// The sample, from 0.
        sample: u32,
    },
    /// Writes depth and shaded colour. Blended classes do not write depth.
    Shaded {
        /// The colour target's format.
        format: wgpu::TextureFormat,
        /// Whether any light is a point or a spot light.
        positional_lights: bool,
        /// Whether the scene has an environment to reflect.
        environment: bool,
        /// Whether a second target takes entity ids; blended classes do not write it.
        identified: bool,
    },
    /// Writes the depth, and the ids where they are wanted, of opaque triangles; tests the depth of others and writes nothing. The shaded pass of a stage without an image.
    Hide {
        /// Whether there is a target for entity ids.
        identified: bool,
    },
    /// Adds up the hashed ids of visible transparent fragments, by pixel, and their number by slot.
    Signature,
    /// The same, under a forced early depth test, for several samples a pixel.
    SignatureEarly,
    /// Marks the pixels of image patches in which anything passes a forced early depth test.
    PatchEarly,
    /// Marks the pixels of image patches in which anything passes a comparison with a depth texture in the shader.
    PatchCompare,
}

impl PipelineKind {
    fn job(self, samples: u32) -> &'static Job {
        let many = samples > 1;
        match self {
            Self::Depth | Self::Query => &depth::JOB,
            Self::CountAtomic => &count_atomic::JOB,
            Self::CountCompare if many => &count_compare_many::JOB,
            Self::CountCompare => &count_compare::JOB,
            Self::Hide { identified: false } => &depth::JOB,
            Self::Identity | Self::Hide { identified: true } => &identity::JOB,
            Self::SampleIdentity { .. } => &sample_identity::JOB,
            Self::Shaded { .. } => &shaded::JOB,
            Self::Signature if many => &signature_many::JOB,
            Self::Signature => &signature::JOB,
            Self::SignatureEarly => &signature_early::JOB,
            Self::PatchEarly => &patch_early::JOB,
            Self::PatchCompare if many => &patch_compare_many::JOB,
            Self::PatchCompare => &patch_compare::JOB,
        }
    }

    /// A shaded kind with entity ids in a second target; any other kind unchanged.
    #[must_use]
    pub fn identified(mut self) -> Self {
        if let Self::Shaded { identified, .. } = &mut self {
            *identified = true;
        }
        self
    }

    fn is_patch(self) -> bool {
        matches!(self, Self::PatchEarly | Self::PatchCompare)
    }

    fn reflects(self) -> bool {
        matches!(
            self,
            Self::Shaded {
                environment: true,
                ..
            }
        )
    }

    fn identifies(self) -> bool {
        matches!(
            self,
            Self::Shaded {
                identified: true,
                ..
            }
        )
    }

    /// Whether the fragment stage runs once a sample, since it counts samples or marks what is visible in any.
    fn runs_by_sample(self, samples: u32, gpu: &Gpu) -> bool {
        match self {
            Self::CountAtomic | Self::CountCompare => samples > 1,
            Self::Signature | Self::SignatureEarly => samples > 1,
            Self::PatchEarly | Self::PatchCompare => samples > 1,
            // naga's GLSL for a sample mask that a shader writes does not compile.
            Self::SampleIdentity { .. } => gpu.info.backend == wgpu::Backend::Gl,
            _ => false,
        }
    }

    /// The entry points of a class's pipeline.
    fn entries(self, class: PipelineClass, samples: u32, gpu: &Gpu) -> EntryPoints {
        let by_sample = self.runs_by_sample(samples, gpu);
        let (vertex, fragment) = match (self.identifies(), self.reflects()) {
            _ if self.masked(class) => match by_sample {
                true => ("masked_vertex", "masked_fragment_of_samples"),
                false => ("masked_vertex", "masked_fragment"),
            },
            _ if self.is_patch() && self.textured(class) => match by_sample {
                true => ("textured_vertex", "textured_fragment_of_samples"),
                false => ("textured_vertex", "textured_fragment"),
            },
            _ if by_sample => ("vertex", "fragment_of_samples"),
            (false, false) => ("vertex", "fragment"),
            (false, true) => ("vertex", "reflecting_fragment"),
            (true, false) => ("identified_vertex", "identified_fragment"),
            (true, true) => ("identified_vertex", "identified_reflecting_fragment"),
        };
        EntryPoints { vertex, fragment }
    }

    /// Number of bind groups. The environment's is the last, and exists only where there is an environment.
    fn groups(self) -> u32 {
        match self {
            Self::Shaded {
                environment: false, ..
            } => ENVIRONMENT_GROUP,
            _ => self.job(1).group_count(),
        }
    }

    fn masked(self, class: PipelineClass) -> bool {
        matches!(self, Self::Identity | Self::SampleIdentity { .. }) && class.alpha() == Alpha::Mask
    }

    /// Whether a class's pipeline reads vertex attributes, materials and a texture.
    pub fn textured(self, class: PipelineClass) -> bool {
        let always = matches!(
            self,
            Self::Shaded { .. } | Self::Signature | Self::SignatureEarly
        );
        always || self.masked(class) || self.is_patch() && class.alpha() != Alpha::Opaque
    }

    /// Whether its bind groups hold materials and a texture.
    pub(crate) fn has_materials(self) -> bool {
        let by_kind = matches!(
            self,
            Self::Shaded { .. }
                | Self::Identity
                | Self::SampleIdentity { .. }
                | Self::Signature
                | Self::SignatureEarly
                | Self::Hide { identified: true }
        );
        by_kind || self.is_patch()
    }
}

/// The entry points of a pipeline.
struct EntryPoints {
    vertex: &'static str,
    fragment: &'static str,
}

/// The pipelines of one kind, by class.
#[derive(Debug)]
pub struct PassPipelines {
    kind: PipelineKind,
    samples: u32,
    by_class: Vec<Option<wgpu::RenderPipeline>>,
    layouts: Vec<wgpu::BindGroupLayout>,
}

impl PassPipelines {
    /// Creates the pipelines for these classes, for targets of `samples` samples a pixel.
    pub fn new(
        gpu: &Gpu,
        kind: PipelineKind,
        samples: u32,
        classes: impl Iterator<Item = PipelineClass>,
    ) -> Self {
        let job = kind.job(samples);
        let layouts = (0..kind.groups())
            .map(|group| {
                gpu.device
                    .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                        label: Some(job.name.as_ref()),
                        entries: &job.layout_entries(group),
                    })
            })
            .collect();
        let none = Self {
            kind,
            samples,
            by_class: vec![None; PipelineClass::COUNT],
            layouts,
        };
        none.with(gpu, classes)
    }

    /// The same pipelines, and those of more classes: what exists is not made again.
    #[must_use]
    pub fn with(&self, gpu: &Gpu, classes: impl Iterator<Item = PipelineClass>) -> Self {
        let job = self.kind.job(self.samples);
        let module = gpu.shader_module(job);
        let groups: Vec<_> = self.layouts.iter().map(Some).collect();
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(job.name.as_ref()),
                bind_group_layouts: &groups,
                immediate_size: 0,
            });
        let mut by_class = self.by_class.clone();
        for class in classes {
            if let Some(place) = by_class.get_mut(class.index())
                && place.is_none()
            {
                *place = Some(self.create(gpu, class, &module, &layout));
            }
        }
        Self {
            kind: self.kind,
            samples: self.samples,
            by_class,
            layouts: self.layouts.clone(),
        }
    }

    /// The kind.
    pub fn kind(&self) -> PipelineKind {
        self.kind
    }

    /// The pipeline of a class; `None` for a class without one.
    pub fn get(&self, class: PipelineClass) -> Option<&wgpu::RenderPipeline> {
        self.by_class.get(class.index())?.as_ref()
    }

    /// The layout of a bind group.
    pub fn layout(&self, group: usize) -> Option<&wgpu::BindGroupLayout> {
        self.layouts.get(group)
    }

    fn create(
        &self,
        gpu: &Gpu,
        class: PipelineClass,
        module: &wgpu::ShaderModule,
        layout: &wgpu::PipelineLayout,
    ) -> wgpu::RenderPipeline {
        let Self { kind, samples, .. } = *self;
        let blended = class.alpha() == Alpha::Blend;
        let EntryPoints { vertex, fragment } = kind.entries(class, samples, gpu);
        let slots = match kind.is_patch() {
            true => SLOT_PATCH_LAYOUT,
            false => SLOT_LAYOUT,
        };
        let full = [Some(POSITION_LAYOUT), Some(slots), Some(ATTRIBUTE_LAYOUT)];
        let bare = &full[..2];
        let constants = match kind {
            PipelineKind::Shaded {
                positional_lights, ..
            } => vec![
                ("alpha_mode", f64::from(class.alpha() as u8)),
                ("textured", f64::from(u8::from(class.textured()))),
                ("positional_lights", f64::from(u8::from(positional_lights))),
            ],
            PipelineKind::SampleIdentity { sample } => vec![("sample", f64::from(sample))],
            _ => Vec::new(),
        };
        let compilation_options = wgpu::PipelineCompilationOptions {
            constants: &constants,
            ..Default::default()
        };
        let target = match kind {
            PipelineKind::Shaded { format, .. } => Some(wgpu::ColorTargetState {
                format,
                blend: blended.then_some(wgpu::BlendState::ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            }),
            PipelineKind::Identity => Some(IDENTITY_FORMAT.into()),
            PipelineKind::SampleIdentity { .. } => Some(SAMPLE_IDENTITY_FORMAT.into()),
            PipelineKind::Hide { identified: true } => Some(wgpu::ColorTargetState {
                format: IDENTITY_FORMAT,
                blend: None,
                write_mask: match class.occludes() {
                    true => wgpu::ColorWrites::ALL,
                    false => wgpu::ColorWrites::empty(),
                },
            }),
            _ => None,
        };
        let ids = kind.identifies().then_some(wgpu::ColorTargetState {
            format: IDENTITY_FORMAT,
            blend: None,
            write_mask: match blended {
                true => wgpu::ColorWrites::empty(),
                false => wgpu::ColorWrites::ALL,
            },
        });
        let targets: Vec<_> = [target, ids].into_iter().filter(Option::is_some).collect();
        let has_fragment = !matches!(
            kind,
            PipelineKind::Depth | PipelineKind::Query | PipelineKind::Hide { identified: false }
        );
        let writes_depth = match kind {
            PipelineKind::Depth | PipelineKind::Identity | PipelineKind::SampleIdentity { .. } => {
                true
            }
            PipelineKind::Shaded { .. } => !blended,
            PipelineKind::Hide { .. } => class.occludes(),
            _ => false,
        };
        // The comparing passes have a depth attachment only because a pass needs an attachment.
        let compares = !matches!(
            kind,
            PipelineKind::CountCompare | PipelineKind::Signature | PipelineKind::PatchCompare
        );
        let compare = match kind {
            _ if !compares => wgpu::CompareFunction::Always,
            // Of what lies in the same place one is drawn over the other, and neither is wrong.
            PipelineKind::PatchEarly => wgpu::CompareFunction::Greater,
            // Reversed depth; a tie counts as visible.
            _ => wgpu::CompareFunction::GreaterEqual,
        };
        gpu.device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(kind.job(samples).name.as_ref()),
                layout: Some(layout),
                vertex: wgpu::VertexState {
                    module,
                    entry_point: Some(vertex),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: if kind.textured(class) { &full } else { bare },
                },
                primitive: wgpu::PrimitiveState {
                    topology: match class.topology() {
                        Primitive::Triangles => wgpu::PrimitiveTopology::TriangleList,
                        Primitive::Lines => wgpu::PrimitiveTopology::LineList,
                        Primitive::Points => wgpu::PrimitiveTopology::PointList,
                    },
                    front_face: if class.mirrored() {
                        wgpu::FrontFace::Cw
                    } else {
                        wgpu::FrontFace::Ccw
                    },
                    cull_mode: (!class.double_sided() && class.topology() == Primitive::Triangles)
                        .then_some(wgpu::Face::Back),
                    ..Default::default()
                },
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: DEPTH_FORMAT,
                    depth_write_enabled: Some(writes_depth),
                    depth_compare: Some(compare),
                    stencil: Default::default(),
                    bias: Default::default(),
                }),
                multisample: wgpu::MultisampleState {
                    count: samples,
                    ..Default::default()
                },
                fragment: has_fragment.then_some(wgpu::FragmentState {
                    module,
                    entry_point: Some(fragment),
                    compilation_options,
                    targets: &targets,
                }),
                multiview_mask: None,
                cache: None,
            })
    }
}
