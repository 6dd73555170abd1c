//! The pipelines that culling itself uses, each made once a stage: declaring a strategy again compiles nothing that exists.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra_shaders::Job;

use crate::boxes::{BoxPipeline, BoxPurpose};
use crate::compute_pipeline::ComputePipeline;
use crate::device::Gpu;

/// Pipelines by what they are.
#[derive(Debug, Default)]
pub(crate) struct Pipelines {
    compute: HashMap<Shader, Arc<ComputePipeline>>,
    boxes: HashMap<(u32, BoxPurpose), Arc<BoxPipeline>>,
}

/// An entry point of a shader. The text tells shaders of one name apart.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Shader {
    source: String,
    entry: &'static str,
}

impl Pipelines {
    /// A compute pipeline.
    pub fn compute(&mut self, gpu: &Gpu, job: &Job, entry: &'static str) -> Arc<ComputePipeline> {
        let shader = Shader {
            source: job.source.to_string(),
            entry,
        };
        let made = self.compute.entry(shader);
        Arc::clone(made.or_insert_with(|| Arc::new(ComputePipeline::new(gpu, job, entry))))
    }

    /// What draws boxes against depths of `samples` samples a pixel.
    pub fn boxes(&mut self, gpu: &Gpu, samples: u32, purpose: BoxPurpose) -> Arc<BoxPipeline> {
        let made = self.boxes.entry((samples, purpose));
        Arc::clone(made.or_insert_with(|| Arc::new(BoxPipeline::new(gpu, samples, purpose))))
    }
}
