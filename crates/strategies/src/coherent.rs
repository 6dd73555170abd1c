//! Coherence between frames and between the views of a stereo pair: the entities that were visible are drawn first, and the others are tested
//! against their depth.
//!
//! Mansa, Amundarain, Garcia-Alonso, Matey, *Occlusion Culling for Stereoscopic Display of Complex Mechanical Sets*, 2007: OCF for one view,
//! scOCF for two. The method is meant for scenes that lie entirely in the frustum and are not densely occluded, so it needs neither a hierarchy nor
//! preparation.
//!
//! | file | content |
//! |---|---|
//! | `single_view.rs` | a view on its own, answers on the host |
//! | `next_view.rs` | a further view that reuses the first one, answers in the same frame |
//! | `on_gpu.rs` | both, without the host |
//! | `memory.rs`, `fraction.rs`, `picker.rs`, `schedule.rs` | what is known of each entity, and which occluded entities a frame tests |

mod entity_test;
mod fraction;
mod memory;
mod next_view;
mod on_gpu;
mod picker;
mod queried_list;
mod schedule;
mod screen_distance;
mod settings;
mod single_view;

use antumbra_graph::Buffer;
use single_view::{DrawnAnswers, ViewState};

use antumbra_cull::{
    DeclareError, FrameGraph, Latency, Setting, SettingError, Step, Strategy, Tunable, Value,
    ViewNodes, VisibleSet, assign,
};

pub use settings::CoherentSettings;

/// The strategy `coherent`: every view on its own (OCF).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Coherent {
    /// The settings of the strategy.
    pub settings: CoherentSettings,
}

/// The strategy `stereo-coherent`: the first view as in `coherent`; the others start with what the first one shows (scOCF).
#[derive(Debug, Clone, Copy, Default)]
pub struct StereoCoherent {
    /// The settings of the strategy.
    pub settings: CoherentSettings,
    /// The first view of the present declaration, for the views after it.
    first: Option<FirstView>,
}

/// What the first view passes on to the views after it.
#[derive(Debug, Clone, Copy)]
enum FirstView {
    /// Memory, lists and verdicts on the host.
    OnHost(ViewState),
    /// The pixels that each slot owns in it, a u32 a slot.
    OnGpu(Buffer),
}

impl StereoCoherent {
    /// The strategy with these settings.
    pub fn new(settings: CoherentSettings) -> Self {
        Self {
            settings,
            first: None,
        }
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
        let settings = self.settings;
        settings.check(self.name(), g)?;
        Ok(match settings.latency {
            Latency::FrameLate => {
                let state = single_view::frame_late(g, view, settings, None);
                VisibleSet::drawn(state.verdicts)
            }
            Latency::SameFrame => {
                let state = single_view::same_frame(g, view, settings, DrawnAnswers::ReadHere);
                VisibleSet::drawn(state.verdicts)
            }
            Latency::OnGpu => on_gpu::first(g, view, settings).set,
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
        let settings = self.settings;
        settings.check(self.name(), g)?;
        let first = self.first.take().filter(|_| view.index() > 0);
        let (set, first) = match (settings.latency, first) {
            (Latency::OnGpu, Some(FirstView::OnGpu(owned))) => (
                on_gpu::next(g, view, settings.testing_all(), owned),
                FirstView::OnGpu(owned),
            ),
            (Latency::OnGpu, _) => {
                let state = on_gpu::first(g, view, settings);
                (state.set, FirstView::OnGpu(state.owned))
            }
            (Latency::FrameLate, Some(FirstView::OnHost(first))) => {
                let lent = Some(first.verdicts);
                let own = single_view::frame_late(g, view, settings.testing_all(), lent);
                (VisibleSet::drawn(own.verdicts), FirstView::OnHost(first))
            }
            (Latency::FrameLate, _) => {
                let state = single_view::frame_late(g, view, settings, None);
                (VisibleSet::drawn(state.verdicts), FirstView::OnHost(state))
            }
            (Latency::SameFrame, Some(FirstView::OnHost(mut first))) => {
                // A third view finds the answers in the memory: the second one has read them.
                let answers = match view.index() {
                    1 => DrawnAnswers::ReadHere,
                    _ => DrawnAnswers::ReadElsewhere,
                };
                let verdicts = next_view::same_frame(g, view, settings, &mut first, answers);
                (VisibleSet::drawn(verdicts), FirstView::OnHost(first))
            }
            (Latency::SameFrame, _) => {
                // The second view, if there is one, reads the answers about what this one draws.
                let answers = match view.is_last() {
                    true => DrawnAnswers::ReadHere,
                    false => DrawnAnswers::ReadElsewhere,
                };
                let state = single_view::same_frame(g, view, settings, answers);
                (VisibleSet::drawn(state.verdicts), FirstView::OnHost(state))
            }
        };
        self.first = Some(first);
        Ok(set)
    }
}
