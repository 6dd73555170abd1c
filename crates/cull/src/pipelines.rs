//! The pipelines that culling itself uses, each compiled once a device. Stages and judges on one device share them, so that another stage, a resize or a strategy that is declared again
//! compiles nothing that exists.

use std::borrow::Cow;
use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use antumbra_shaders::{Job, jobs};

use crate::boxes::{BoxPipeline, BoxPurpose};
use crate::compute_pipeline::ComputePipeline;
use crate::device::Gpu;

/// The pipelines of a device. They live as long as it does.
#[derive(Debug, Default)]
pub(crate) struct Pipelines {
    compute: Kept<Shader, ComputePipeline>,
    boxes: Kept<Boxes, BoxPipeline>,
}

/// An entry point of a shader. The text tells shaders of one name apart.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Shader {
    source: Cow<'static, str>,
    entry: &'static str,
}

/// What draws boxes.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Boxes {
    source: Cow<'static, str>,
    samples: u32,
    purpose: BoxPurpose,
}

/// What is made once a key. Who asks for the same key meanwhile waits, who asks for another one does not.
#[derive(Debug)]
struct Kept<K, V>(Mutex<HashMap<K, Arc<OnceLock<Arc<V>>>>>);

impl<K, V> Default for Kept<K, V> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: Eq + Hash, V> Kept<K, V> {
    fn get(&self, key: K, make: impl FnOnce() -> V) -> Arc<V> {
        // Keys are only added: what was made before a panic is whole.
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = Arc::clone(kept.entry(key).or_default());
        drop(kept);
        Arc::clone(place.get_or_init(|| Arc::new(make())))
    }
}

impl Gpu {
    /// A compute pipeline of this device.
    pub(crate) fn compute_pipeline(&self, job: &Job, entry: &'static str) -> Arc<ComputePipeline> {
        let source = self.shader_text(job);
        let make = || ComputePipeline::compile(self, job, entry);
        self.pipelines.compute.get(Shader { source, entry }, make)
    }

    /// What draws boxes against depths of `samples` samples a pixel.
    pub(crate) fn box_pipeline(&self, samples: u32, purpose: BoxPurpose) -> Arc<BoxPipeline> {
        let boxes = Boxes {
            source: self.shader_text(&jobs::boxes::JOB),
            samples,
            purpose,
        };
        let make = || BoxPipeline::new(self, samples, purpose);
        self.pipelines.boxes.get(boxes, make)
    }
}
