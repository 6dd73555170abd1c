//! Two phases with a depth pyramid. What was visible in the last frame is drawn first; its depth becomes a pyramid; the boxes of all entities are tested against that, and
//! what is found is drawn. No query, no prepass, nothing read back, no sync point.
//!
//! Haar and Aaltonen, *GPU-Driven Rendering Pipelines*, 2015, after Greene, Kass and Miller, *Hierarchical Z-Buffer Visibility*, 1993. It is right by construction: whatever
//! the first phase draws, an entity that is not drawn at the end was tested against depth that is in the image, in this frame and from this camera. So cuts, moved
//! and new entities need no care. Transparent entities are tested, and hide nothing; those with a mask hide by what is left of them.

use antumbra_cull::{
    DeclareError, FrameGraph, Latency, Parameter, Setting, SettingError, Strategy, Tunable, Value,
    ViewNodes, VisibleSet, assign, describe,
};

use crate::found_on_gpu::{ExemptEntities, opaque, shade_found_transparent, verdicts};
use crate::rivals::{self, Rival};

/// The strategy `depth-pyramid`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct DepthPyramid {
    /// The engine whose test is played instead, as a yardstick; `None`: none. Then no other setting counts.
    pub like: Option<Rival>,
}

const PARAMETERS: &[Parameter<DepthPyramid>] = &[Parameter::words(
    "like",
    &[
        "ours",
        "bevy",
        "bevy-meshlets",
        "niagara",
        "helio",
        "unity",
        "vk-lod-clusters",
    ],
    "the engine whose test is played, for study: docs/rivals.md; ours: none",
    |s| s.like.map_or("ours", Rival::word),
    |s, at| s.like = at.checked_sub(1).map(|at| Rival::ALL[at]),
)];

impl Strategy for DepthPyramid {
    fn name(&self) -> &str {
        "depth-pyramid"
    }

    fn summary(&self) -> &str {
        self.like.map_or("draws last frame's visible first, tests all boxes against a pyramid of its depth, and draws what it finds (Haar and Aaltonen 2015)", Rival::summary)
    }

    fn conservative(&self) -> bool {
        self.like.is_none()
    }

    fn latency(&self) -> Option<Latency> {
        Some(Latency::OnGpu)
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
        if g.samples() > 1 && !g.gpu().reads_drawn_samples() {
            return Err(DeclareError::Device {
                strategy: self.name().to_owned(),
                lacking: "shaders that read the samples of what was drawn".to_owned(),
                instead: "draw one sample a pixel, or take another strategy".to_owned(),
            });
        }
        if let Some(rival) = self.like {
            return rivals::declare(rival, g, view);
        }
        let candidates = g.in_frustum(view);
        let history = g.sample_counts(view);
        let seen = history.previous();
        let name = "last visible";
        let all = opaque(g, view, name, candidates, ExemptEntities::Included);
        let last = g.compact(view, name, all, seen);
        g.shade_indirect(view, "shade last visible", last);
        let tested = g.test_boxes(view, seen, history);
        let name = "found visible";
        let rest = opaque(g, view, name, candidates, ExemptEntities::LeftOut);
        let new = g.compact(view, name, rest, tested.rest);
        g.shade_indirect(view, "shade found visible", new);
        shade_found_transparent(g, view, candidates, tested.found);
        Ok(verdicts(g, view, candidates, tested.drawn))
    }
}

impl Tunable for DepthPyramid {
    fn settings(&self) -> Vec<Setting> {
        describe(PARAMETERS, self)
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        assign("depth-pyramid", PARAMETERS, self, key, value)
    }
}
