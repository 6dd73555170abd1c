//! CoherentSettings from frame to frame and from eye to eye: what was visible is drawn first and hides the rest.
//!
//! Mansa, Amundarain, Garcia-Alonso, Matey, *Occlusion Culling for Stereoscopic Display of Complex Mechanical Sets*, 2007: OCF for one eye, scOCF for
//! two. The scenes it is for are whole in the frustum and not densely occluded, so there is no hierarchy to walk and nothing to prepare.

mod fraction;
mod memory;
mod next_view;
mod on_gpu;
mod queried_list;
mod schedule;
mod screen_distance;
mod settings;
mod single_view;

use antumbra_graph::Buffer;
use fraction::Share;
use single_view::Eye;

use antumbra_cull::{
    DeclareError, FrameGraph, Latency, Setting, SettingError, Step, Strategy, Tunable, Value,
    ViewNodes, VisibleSet, assign, describe,
};

/// What both strategies can be told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoherentSettings {
    /// When the answers of the tests are used.
    pub latency: Latency,
    /// The part of the occluded that is tested a frame: above 0, at most 1. Below 1 what appears may be late.
    pub fraction: f64,
    /// How many entities may be late on average: the fraction grows as far as that needs. 0: it is fixed.
    pub late: f64,
    /// How far the camera moves before the visible are sorted anew, as a part of its distance to the one in the middle of their list.
    pub resort: f64,
    /// Up to how many of the occluded are asked about together, by one query: where it finds a sample, all of them are drawn and asked about alone next
    /// time. 1: each alone, as in the paper.
    pub together: u32,
}

impl Default for CoherentSettings {
    fn default() -> Self {
        Self {
            latency: Latency::FrameLate,
            fraction: 1.0,
            late: 0.0,
            resort: 0.01,
            together: 8,
        }
    }
}

impl CoherentSettings {
    fn share(self) -> Share {
        Share {
            least: self.fraction,
            late: self.late,
        }
    }

    /// The same with all of the occluded tested: an eye after the first needs no fraction (section 3.2).
    fn whole(self) -> Self {
        Self {
            fraction: 1.0,
            late: 0.0,
            ..self
        }
    }

    /// Refuses what does not go together.
    fn check(self, strategy: &str) -> Result<(), DeclareError> {
        if self.latency == Latency::OnGpu && self.late > 0.0 {
            return Err(DeclareError::Settings {
                strategy: strategy.to_owned(),
                conflict: "a fraction that adapts needs answers on the host: set late to 0, or latency to frame-late or same-frame".to_owned(),
            });
        }
        Ok(())
    }

    fn conservative(self) -> bool {
        self.latency != Latency::FrameLate && self.fraction >= 1.0
    }
}

impl Tunable for CoherentSettings {
    fn settings(&self) -> Vec<Setting> {
        describe(settings::PARAMETERS, self)
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        assign("coherent", settings::PARAMETERS, self, key, value)
    }

    /// From all of the occluded entities tested to a twentieth of them.
    fn steps(&self) -> Vec<Step> {
        let now = match self.latency {
            Latency::SameFrame => Latency::SameFrame,
            Latency::FrameLate | Latency::OnGpu => Latency::OnGpu,
        };
        let step = |latency: Latency, fraction: f64| {
            Step::of([
                ("late", 0u32.into()),
                ("latency", latency.word().into()),
                ("fraction", fraction.into()),
            ])
        };
        let mut steps = vec![step(now, 1.0)];
        if self.latency == Latency::FrameLate {
            steps.push(step(self.latency, 1.0));
        }
        let parts = [0.7, 0.5, 0.35, 0.2, 0.1, 0.05];
        steps.extend(parts.map(|part| step(self.latency, part)));
        steps
    }
}

impl Tunable for StereoCoherent {
    fn settings(&self) -> Vec<Setting> {
        self.settings.settings()
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        assign(
            "stereo-coherent",
            settings::PARAMETERS,
            &mut self.settings,
            key,
            value,
        )
    }

    fn steps(&self) -> Vec<Step> {
        self.settings.steps()
    }
}

/// The strategy `coherent`: each view on its own (OCF).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Coherent {
    /// Its settings.
    pub settings: CoherentSettings,
}

/// The strategy `stereo-coherent`: the first view as `coherent` does it, the others from what the first one saw (scOCF).
#[derive(Debug, Clone, Copy, Default)]
pub struct StereoCoherent {
    /// Its settings.
    pub settings: CoherentSettings,
    first: Option<First>,
}

/// What the first eye leaves to the others.
#[derive(Debug, Clone, Copy)]
enum First {
    OnHost(Eye),
    /// How many pixels each slot owns in it.
    OnGpu(Buffer),
}

impl StereoCoherent {
    /// With these settings.
    pub fn new(coherence: CoherentSettings) -> Self {
        Self {
            settings: coherence,
            first: None,
        }
    }
}

impl Strategy for Coherent {
    fn name(&self) -> &str {
        "coherent"
    }

    fn summary(&self) -> &str {
        "draws last frame's visible first, each with a query, and tests a fraction of the rest (Mansa et al. 2006)"
    }

    fn conservative(&self) -> bool {
        self.settings.conservative()
    }

    fn latency(&self) -> Option<Latency> {
        Some(self.settings.latency)
    }

    fn tuning(&self) -> Option<&dyn Tunable> {
        Some(&self.settings)
    }

    fn tuning_mut(&mut self) -> Option<&mut dyn Tunable> {
        Some(&mut self.settings)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let how = self.settings;
        how.check(self.name())?;
        Ok(match how.latency {
            Latency::FrameLate => {
                VisibleSet::drawn(single_view::frame_late(g, view, how, None).verdicts)
            }
            Latency::SameFrame => {
                VisibleSet::drawn(single_view::same_frame(g, view, how, true).verdicts)
            }
            Latency::OnGpu => on_gpu::first(g, view, how).set,
        })
    }
}

impl Strategy for StereoCoherent {
    fn name(&self) -> &str {
        "stereo-coherent"
    }

    fn summary(&self) -> &str {
        "as coherent for the left eye; the right one draws what the left saw and tests what it did not (Mansa et al. 2007)"
    }

    fn conservative(&self) -> bool {
        self.settings.conservative()
    }

    fn latency(&self) -> Option<Latency> {
        Some(self.settings.latency)
    }

    fn tuning(&self) -> Option<&dyn Tunable> {
        Some(self)
    }

    fn tuning_mut(&mut self) -> Option<&mut dyn Tunable> {
        Some(self)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let how = self.settings;
        how.check(self.name())?;
        let first = self.first.take().filter(|_| view.index() > 0);
        let (set, first) = match (how.latency, first) {
            (Latency::OnGpu, Some(First::OnGpu(owned))) => (
                on_gpu::next(g, view, how.whole(), owned),
                First::OnGpu(owned),
            ),
            (Latency::OnGpu, _) => {
                let eye = on_gpu::first(g, view, how);
                (eye.set, First::OnGpu(eye.owned))
            }
            (Latency::FrameLate, Some(First::OnHost(eye))) => {
                let own = single_view::frame_late(g, view, how.whole(), Some(eye.verdicts));
                (VisibleSet::drawn(own.verdicts), First::OnHost(eye))
            }
            (Latency::FrameLate, _) => {
                let eye = single_view::frame_late(g, view, how, None);
                (VisibleSet::drawn(eye.verdicts), First::OnHost(eye))
            }
            (Latency::SameFrame, Some(First::OnHost(mut eye))) => {
                // A third view finds in the memory what the second one has collected.
                let collects = view.index() == 1;
                let verdicts = next_view::same_frame(g, view, how, &mut eye, collects);
                (VisibleSet::drawn(verdicts), First::OnHost(eye))
            }
            (Latency::SameFrame, _) => {
                // Its answers are the next eye's to collect, where there is one.
                let eye = single_view::same_frame(g, view, how, view.is_last());
                (VisibleSet::drawn(eye.verdicts), First::OnHost(eye))
            }
        };
        self.first = Some(first);
        Ok(set)
    }
}
