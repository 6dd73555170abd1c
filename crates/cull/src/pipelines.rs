//! The pipelines of a stage, each made once: declaring a strategy again compiles nothing that exists.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra_draw::boxes::BoxPipeline;
use antumbra_draw::{Gpu, PassPipelines, PipelineKind, SceneLayout};
use antumbra_shaders::Job;

use crate::compute_pipeline::ComputePipeline;

/// Pipelines by what they are.
#[derive(Debug, Default)]
pub(crate) struct Pipelines {
    passes: HashMap<PipelineKind, Arc<PassPipelines>>,
    compute: HashMap<Shader, Arc<ComputePipeline>>,
    boxes: Option<Arc<BoxPipeline>>,
}

/// An entry point of a shader. The text tells shaders of one name apart.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Shader {
    source: String,
    entry: &'static str,
}

impl Pipelines {
    /// A pass's pipelines, for all classes of a scene: what a scene has gained since is added.
    pub fn pass(
        &mut self,
        gpu: &Gpu,
        kind: PipelineKind,
        layout: &SceneLayout,
    ) -> Arc<PassPipelines> {
        let made = self
            .passes
            .entry(kind)
            .or_insert_with(|| Arc::new(PassPipelines::new(gpu, kind, layout.classes())));
        if layout.classes().any(|class| made.get(class).is_none()) {
            *made = Arc::new(made.with(gpu, layout.classes()));
        }
        Arc::clone(made)
    }

    /// A compute pipeline.
    pub fn compute(&mut self, gpu: &Gpu, job: &Job, entry: &'static str) -> Arc<ComputePipeline> {
        let shader = Shader {
            source: job.source.to_string(),
            entry,
        };
        let made = self.compute.entry(shader);
        Arc::clone(made.or_insert_with(|| Arc::new(ComputePipeline::new(gpu, job, entry))))
    }

    /// What draws boxes.
    pub fn boxes(&mut self, gpu: &Gpu) -> Arc<BoxPipeline> {
        Arc::clone(
            self.boxes
                .get_or_insert_with(|| Arc::new(BoxPipeline::new(gpu))),
        )
    }
}
