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
<<<<<<< HEAD
    compute: Kept<Shader, ComputePipeline>,
    /// By samples a pixel.
    boxes: Kept<(Cow<'static, str>, u32), BoxPipeline>,
=======
    compute: HashMap<Shader, Arc<ComputePipeline>>,
    boxes: HashMap<(u32, BoxPurpose), Arc<BoxPipeline>>,
>>>>>>> b09b2aa180182835713c2cec566b6b322515a2b6
}

/// An entry point of a shader. The text tells shaders of one name apart.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Shader {
    source: Cow<'static, str>,
    entry: &'static str,
}

/// What is made once a key. Who asks for the same key meanwhile waits, who asks for another one does not.
#[derive(Debug)]
struct Kept<K, V>(Mutex<HashMap<K, Arc<OnceLock<Arc<V>>>>>);

<<<<<<< HEAD
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
    pub(crate) fn box_pipeline(&self, samples: u32) -> Arc<BoxPipeline> {
        let source = self.shader_text(&jobs::boxes::JOB);
        let make = || BoxPipeline::new(self, samples);
        self.pipelines.boxes.get((source, samples), make)
=======
    /// What draws boxes against depths of `samples` samples a pixel.
    pub fn boxes(&mut self, gpu: &Gpu, samples: u32, purpose: BoxPurpose) -> Arc<BoxPipeline> {
        let made = self.boxes.entry((samples, purpose));
        Arc::clone(made.or_insert_with(|| Arc::new(BoxPipeline::new(gpu, samples, purpose))))
>>>>>>> b09b2aa180182835713c2cec566b6b322515a2b6
    }
}
