//! Two phases with a depth pyramid. What was visible in the last frame is drawn first; its depth becomes a pyramid; the boxes of all entities are tested against that, and
//! what is found is drawn. No query, no prepass, nothing read back, no sync point.
//!
//! Haar and Aaltonen, *GPU-Driven Rendering Pipelines*, 2015, after Greene, Kass and Miller, *Hierarchical Z-Buffer Visibility*, 1993. It is right by construction: whatever
//! the first phase draws, an entity that is not drawn at the end was tested against depth that is in the image, in this frame and from this camera. So cuts, moved
//! and new entities need no care. Transparent entities are tested, and hide nothing; those with a mask hide by what is left of them.

use antumbra_cull::indirect::IndirectLayout;
use antumbra_cull::{
    Candidates, DeclareError, FrameGraph, Latency, Strategy, ViewNodes, VisibleSet,
};
use antumbra_graph::Host;

use crate::found_on_gpu::{ExemptEntities, opaque, transparent, verdicts};

/// The strategy `depth-pyramid`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct DepthPyramid;

impl Strategy for DepthPyramid {
    fn name(&self) -> &str {
        "depth-pyramid"
    }

    fn summary(&self) -> &str {
        "draws last frame's visible first, tests all boxes against a pyramid of its depth, and draws what it finds (Haar and Aaltonen 2015)"
    }

    fn conservative(&self) -> bool {
        true
    }

    fn latency(&self) -> Option<Latency> {
        Some(Latency::OnGpu)
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
        let boxes = g.view_boxes(view);
        let history = g.sample_counts(view);
        let first = g.first_by_boxes(view, boxes, history.previous());
        let choices = Choices::of(g, view);
        let last = g.compact(view, "last visible", choices.opaque, first);
        g.shade_indirect(view, "shade last visible", last);
        let tested = g.test_boxes(view, boxes, first, history);
        let new = g.compact(view, "found visible", choices.opaque, tested.rest);
        g.shade_indirect(view, "shade found visible", new);
        if let Some(transparent) = choices.transparent {
            let kept = g.compact(view, "visible transparent set", transparent, tested.drawn);
            g.shade_indirect(view, "transparent", kept);
        }
        Ok(match choices.candidates {
            Some(candidates) => verdicts(g, view, candidates, tested.drawn),
            None => VisibleSet::drawn_on_gpu(tested.drawn),
        })
    }
}

/// What is chosen from.
struct Choices {
    opaque: IndirectLayout,
    transparent: Option<IndirectLayout>,
    /// In a chain: what the strategy before has left. Otherwise the device alone says what is in the frustum.
    candidates: Option<Host<Candidates>>,
}

impl Choices {
    fn of(g: &mut FrameGraph<'_>, view: &mut ViewNodes) -> Self {
        let any_transparent = g.scene_layout().transparent;
        if view.narrowed_to().is_none() {
            return Self {
                opaque: g.resident_scene(view).opaque,
                transparent: any_transparent.then(|| g.resident_transparent(view)),
                candidates: None,
            };
        }
        let left = g.in_frustum(view);
        Self {
            opaque: opaque(g, view, "candidates", left, ExemptEntities::Counted),
            transparent: any_transparent.then(|| transparent(g, view, left)),
            candidates: Some(left),
        }
    }
}
