//! The self-test of a driver: a few passes and dispatches over a hand-made picture, whose answers are known beforehand.
//!
//! Drivers lose writes, leave levels of a texture stale and answer queries with zero, and then objects vanish without an error. So a driver is not believed but tried: each
//! capability that strategies are made of, with the shaders and pipelines that they use. All that is tried at once is one submission and one wait, and nothing is tried twice on a device.

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
mod scene;
mod trial;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, PoisonError};

use bench::Bench;
use scene::Scene;
use trial::Trial;

pub use report::{Capability, Failure, Outcome, SelfTestReport};

use crate::counting::Counting;
use crate::device::{DeviceError, Gpu};

/// What the self-tests of a device found, by samples a pixel. A report has what was tried so far.
#[derive(Debug, Default)]
pub(crate) struct SelfTests {
    reports: Mutex<BTreeMap<u32, Arc<SelfTestReport>>>,
    /// Held by who tries and blocks, so that others wait for what is found.
    blocking: Mutex<()>,
}

impl SelfTests {
    /// What is known with so many samples a pixel.
    fn known(&self, samples: u32) -> Arc<SelfTestReport> {
        let mut reports = self.reports.lock().unwrap_or_else(PoisonError::into_inner);
        let known = reports.entry(samples).or_insert_with(|| {
            Arc::new(SelfTestReport {
                samples,
                outcomes: Vec::new(),
            })
        });
        Arc::clone(known)
    }

    /// Adds what was found.
    fn learn(&self, samples: u32, found: Vec<(Capability, Outcome)>) {
        let known = self.known(samples);
        let new = found
            .into_iter()
            .filter(|(capability, _)| known.outcome(*capability).is_none());
        let mut outcomes: Vec<_> = known.outcomes.iter().cloned().chain(new).collect();
        outcomes.sort_by_key(|(capability, _)| *capability);
        let mut reports = self.reports.lock().unwrap_or_else(PoisonError::into_inner);
        reports.insert(samples, Arc::new(SelfTestReport { samples, outcomes }));
    }
}

impl Gpu {
    /// Tries all that strategies need of the driver, with so many samples a pixel, and returns what was found. It submits and waits. What was tried before, here or when a stage was
    /// made ([`DistrustOptions::self_test`](crate::DistrustOptions)), is not tried again: a host that must not wait there calls this earlier.
    ///
    /// # Errors
    /// As for [`Self::self_test_async`]; [`DeviceError::CannotWait`] in a browser.
    pub fn self_test(&self, samples: u32) -> Result<Arc<SelfTestReport>, DeviceError> {
        let all = Capability::ALL.into_iter().collect();
        self.tried(samples, &all)
    }

    /// [`Self::self_test`], to be awaited: a page does that before it makes stages, which cannot wait there.
    ///
    /// # Errors
    /// [`DeviceError::Samples`] for samples that the device does not have; [`DeviceError::Lost`] where the device is lost meanwhile.
    pub async fn self_test_async(&self, samples: u32) -> Result<Arc<SelfTestReport>, DeviceError> {
        self.check_samples(samples)?;
        let new = self.untried(samples, &Capability::ALL.into_iter().collect());
        let found = run(self, samples, new).await?;
        self.self_tests.learn(samples, found);
        Ok(self.self_tests.known(samples))
    }

    /// The same of these capabilities alone.
    pub(crate) fn tried(
        &self,
        samples: u32,
        capabilities: &BTreeSet<Capability>,
    ) -> Result<Arc<SelfTestReport>, DeviceError> {
        self.check_samples(samples)?;
        let blocking = self.self_tests.blocking.lock();
        let _blocking = blocking.unwrap_or_else(PoisonError::into_inner);
        let new = self.untried(samples, capabilities);
        if !new.is_empty() {
            let found = self.block_on(
                "the self-test of a driver",
                "`Gpu::self_test_async`, before any stage is made, or `DistrustOptions::OFF`",
                run(self, samples, new),
            )?;
            self.self_tests.learn(samples, found);
        }
        Ok(self.self_tests.known(samples))
    }

    /// Those of the capabilities that were not tried yet.
    fn untried(&self, samples: u32, capabilities: &BTreeSet<Capability>) -> BTreeSet<Capability> {
        let known = self.self_tests.known(samples);
        let capabilities = capabilities.iter().copied();
        capabilities
            .filter(|capability| known.outcome(*capability).is_none())
            .collect()
    }
}

/// Runs the trials that the device has what it takes for.
async fn run(
    gpu: &Gpu,
    samples: u32,
    capabilities: BTreeSet<Capability>,
) -> Result<Vec<(Capability, Outcome)>, DeviceError> {
    let mut bench = Bench::new(gpu, samples);
    let scene = bench.attempt(Scene::new).await;
    let mut trials = Vec::new();
    for capability in capabilities {
        let trial = match (lacking(gpu, samples, capability), &scene) {
            (Some(lacking), _) => Err(Outcome::NotAvailable(lacking.to_owned())),
            (None, Err(failure)) => Err(Outcome::Failed(failure.clone())),
            (None, Ok(scene)) => bench
                .attempt(|bench| record(bench, scene, capability))
                .await
                .map_err(Outcome::Failed),
        };
        trials.push((capability, trial));
    }
    let answers = bench.finish().await?;
    let judged = trials.into_iter().map(|(capability, trial)| {
        let outcome = match trial {
            Ok(trial) => trial.judged(&answers),
            Err(outcome) => outcome,
        };
        if let Outcome::Failed(failure) = &outcome {
            tracing::warn!(
                adapter = gpu.title(),
                samples,
                "self-test: {capability}: {failure}"
            );
        }
        (capability, outcome)
    });
    Ok(judged.collect())
}

/// Records the trial of a capability.
fn record(bench: &mut Bench<'_>, scene: &Scene, capability: Capability) -> Trial {
    match capability {
        Capability::FragmentAtomics => fragments::record(bench, scene, Counting::Atomics),
        Capability::FragmentCompare => fragments::record(bench, scene, Counting::Compare),
        Capability::IdHistogram => ids::record(bench, scene),
        Capability::OcclusionQueries => queries::record(bench, scene),
        Capability::DepthPyramid => pyramid::record(bench, scene),
        Capability::BoxTest => boxes::record(bench, scene),
        Capability::Compaction => compaction::record(bench),
        Capability::IndirectFirstInstance => indirect::record(bench, scene),
    }
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
