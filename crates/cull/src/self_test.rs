//! The self-test of a driver: a few passes and dispatches over a hand-made picture, whose answers are known beforehand.
//!
//! Drivers lose writes, leave levels of a texture stale and answer queries with zero, and then objects vanish without an error. So a driver is not believed but tried: each
//! capability that strategies are made of, with the shaders and pipelines that they use. All of it is one submission and one wait, and is done once a device.

mod bench;
mod boxes;
mod compaction;
mod fragments;
mod ids;
mod indirect;
mod picture;
mod pyramid;
mod queries;
mod raster;
mod report;
mod trial;

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use bench::Bench;
use raster::Scene;

pub use report::{Capability, Failure, Outcome, SelfTestReport};

use crate::counting::Counting;
use crate::device::{DeviceError, Gpu};
use crate::pipelines::Pipelines;

/// What the self-tests of a device found, by samples a pixel.
#[derive(Debug, Default)]
pub(crate) struct SelfTests(Mutex<BTreeMap<u32, Tested>>);

/// A self-test that has run.
#[derive(Debug, Clone)]
pub(crate) struct Tested {
    pub report: Arc<SelfTestReport>,
    /// What it has compiled: stages go on from it.
    pub pipelines: Pipelines,
}

impl Gpu {
    /// Tries what strategies need of the driver, with so many samples a pixel, and returns what was found. It runs once a device and number of samples, submits and waits;
    /// later calls return the same report at once. A stage does this when it is made ([`DistrustOptions::self_test`](crate::DistrustOptions)): a host that must not wait there calls it earlier.
    ///
    /// # Errors
    /// [`DeviceError::Samples`] for samples that the device does not have; [`DeviceError::Lost`] where the device is lost meanwhile.
    pub fn self_test(&self, samples: u32) -> Result<Arc<SelfTestReport>, DeviceError> {
        Ok(self.tested(samples)?.report)
    }

    /// The same, with what was compiled.
    pub(crate) fn tested(&self, samples: u32) -> Result<Tested, DeviceError> {
        self.check_samples(samples)?;
        let mut tests = self
            .self_tests
            .0
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if let Some(tested) = tests.get(&samples) {
            return Ok(tested.clone());
        }
        let tested = run(self, samples)?;
        tests.insert(samples, tested.clone());
        Ok(tested)
    }
}

/// Runs all trials that the device has what it takes for.
fn run(gpu: &Gpu, samples: u32) -> Result<Tested, DeviceError> {
    let mut pipelines = Pipelines::default();
    let mut bench = Bench::new(gpu, &mut pipelines, samples);
    let scene = bench.attempt(Scene::new);
    let mut pyramid = None;
    let mut trials = Vec::new();
    for capability in Capability::ALL {
        let lacking = lacking(gpu, samples, capability);
        let trial = match (&lacking, &scene) {
            (Some(_), _) => None,
            (None, Err(failure)) => Some(Err(failure.clone())),
            (None, Ok(scene)) => bench
                .attempt(|bench| {
                    Some(match capability {
                        Capability::FragmentAtomics => {
                            fragments::record(bench, scene, Counting::Atomics)
                        }
                        Capability::FragmentCompare => {
                            fragments::record(bench, scene, Counting::Compare)
                        }
                        Capability::IdHistogram => ids::record(bench, scene),
                        Capability::OcclusionQueries => queries::record(bench, scene),
                        Capability::DepthPyramid => {
                            let (trial, made) = pyramid::record(bench, scene);
                            pyramid = Some(made);
                            trial
                        }
                        Capability::BoxTest => boxes::record(bench, scene, pyramid.as_ref()?),
                        Capability::Compaction => compaction::record(bench),
                        Capability::IndirectFirstInstance => indirect::record(bench),
                    })
                })
                .transpose(),
        };
        trials.push((capability, lacking, trial));
    }
    let answers = bench.finish()?;
    let outcomes = trials.into_iter().map(|(capability, lacking, trial)| {
        let outcome = match trial {
            Some(Ok(trial)) => trial.judged(&answers),
            Some(Err(failure)) => Outcome::Failed(failure),
            None => Outcome::NotAvailable(lacking.unwrap_or("a depth pyramid").to_owned()),
        };
        (capability, outcome)
    });
    let report = SelfTestReport {
        samples,
        outcomes: outcomes.collect(),
    };
    for (capability, failure) in report.failures() {
        tracing::warn!(
            adapter = gpu.title(),
            samples,
            "self-test: {capability}: {failure}"
        );
    }
    Ok(Tested {
        report: Arc::new(report),
        pipelines,
    })
}

/// What the device lacks for a capability; `None` where it has it.
fn lacking(gpu: &Gpu, samples: u32, capability: Capability) -> Option<&'static str> {
    let has = |flag| gpu.downlevel.flags.contains(flag);
    let computes = has(wgpu::DownlevelFlags::COMPUTE_SHADERS);
    match capability {
        Capability::FragmentAtomics => Counting::Atomics.lacking(gpu, samples),
        Capability::FragmentCompare => Counting::Compare.lacking(gpu, samples),
        Capability::IdHistogram => Counting::Identity.lacking(gpu, samples),
        Capability::OcclusionQueries => Counting::Queries.lacking(gpu, samples),
        Capability::DepthPyramid | Capability::BoxTest | Capability::Compaction if !computes => {
            Some("compute shaders")
        }
        Capability::DepthPyramid | Capability::BoxTest
            if samples > 1 && !gpu.reads_drawn_samples() =>
        {
            Some("shaders that read the samples of what was drawn")
        }
        Capability::DepthPyramid | Capability::BoxTest | Capability::Compaction => None,
        Capability::IndirectFirstInstance => {
            let features = gpu.device.features();
            let begins = features.contains(wgpu::Features::INDIRECT_FIRST_INSTANCE);
            match has(wgpu::DownlevelFlags::INDIRECT_EXECUTION) && begins {
                true => None,
                false => Some("indirect draws that begin at other instances than the first"),
            }
        }
    }
}
