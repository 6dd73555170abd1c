//! Two phases with a depth pyramid. What was visible in the last frame is drawn first; its depth becomes a pyramid; the boxes of all entities are tested against that, and
//! what is found is drawn. No query, no prepass, nothing read back, no sync point.
//!
//! Haar and Aaltonen, *GPU-Driven Rendering Pipelines*, 2015, after Greene, Kass and Miller, *Hierarchical Z-Buffer Visibility*, 1993. It is right by construction: whatever
//! the first phase draws, an entity that is not drawn at the end was tested against depth that is in the image, in this frame and from this camera. So cuts, moved
//! and new entities need no care. Transparent entities are tested, and hide nothing; those with a mask hide by what is left of them.

use antumbra_cull::indirect::IndirectLayout;
use antumbra_cull::{
    Candidates, DeclareError, FrameGraph, Latency, Parameter, Setting, SettingError, Step,
    Strategy, TestDetail, TestRules, TestShape, Tunable, UnknownEntities, Value, ViewNodes,
    VisibleSet, assign, describe,
};
use antumbra_graph::Host;

use crate::found_on_gpu::{ExemptEntities, opaque, transparent, verdicts};
use crate::rivals::{self, Rival};

/// The strategy `depth-pyramid`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct DepthPyramid {
    /// In how many phases it draws.
    pub phases: DrawPhases,
    /// How it is remembered what was visible.
    pub history: History,
    /// Which shapes are tested.
    pub shape: TestShape,
    /// How closely the depth is inspected.
    pub detail: TestDetail,
    /// With one phase, what is done with what nothing is known of.
    pub late: LateEntities,
    /// The engine whose test is played instead, as a yardstick; `None`: none. Then no other setting counts.
    pub like: Option<Rival>,
}

/// In how many phases is drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum DrawPhases {
    /// What was visible, then what is found.
    #[default]
    Two,
    /// What was visible, as of the last frame: entities appear a frame late.
    One,
}

/// How it is remembered what was visible.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum History {
    /// A word a slot: what the last frame's test found.
    #[default]
    Bits,
    /// The last frame's pyramid: boxes are tested against it, from the last frame's view, where they are now.
    Pyramid,
}

/// What is done with entities that nothing is known of, where there is one phase.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum LateEntities {
    /// They are drawn.
    #[default]
    Keep,
    /// They are culled until they were tested.
    Cull,
}

const PARAMETERS: &[Parameter<DepthPyramid>] = &[
    Parameter::words(
        "phases",
        &["2", "1"],
        "2: what was visible is drawn, then what is found; 1: what was visible alone, so that entities appear a frame late",
        |s| ["2", "1"][s.phases as usize],
        |s, at| s.phases = [DrawPhases::Two, DrawPhases::One][at],
    ),
    Parameter::words(
        "history",
        &["bits", "pyramid"],
        "how it is remembered what was visible: what the last test found, or the last frame's pyramid",
        |s| ["bits", "pyramid"][s.history as usize],
        |s, at| s.history = [History::Bits, History::Pyramid][at],
    ),
    Parameter::words(
        "shape",
        &["parts", "ellipsoid", "box"],
        "what is tested: each entity's box, the ellipsoid around it and the boxes of its mesh's parts; without those of parts; or its box alone",
        |s| ["parts", "ellipsoid", "box"][s.shape as usize],
        |s, at| s.shape = [TestShape::Parts, TestShape::Ellipsoid, TestShape::Box][at],
    ),
    Parameter::words(
        "detail",
        &["pixel", "pyramid"],
        "how closely the depth is inspected: down to the pixel, or at most 4 x 4 texels of the pyramid",
        |s| ["pixel", "pyramid"][s.detail as usize],
        |s, at| s.detail = [TestDetail::Pixel, TestDetail::Pyramid][at],
    ),
    Parameter::words(
        "late",
        &["keep", "cull"],
        "with one phase, whether entities that nothing is known of are drawn, or culled until they were tested",
        |s| ["keep", "cull"][s.late as usize],
        |s, at| s.late = [LateEntities::Keep, LateEntities::Cull][at],
    ),
    Parameter::words(
        "like",
        &[
            "ours",
            "bevy",
            "bevy-meshlets",
            "niagara",
            "helio",
            "unity",
            "vk_lod_clusters",
        ],
        "the engine whose test is played, for study: docs/rivals.md; ours: none",
        |s| s.like.map_or("ours", Rival::word),
        |s, at| s.like = at.checked_sub(1).map(|at| Rival::ALL[at]),
    ),
];

impl DepthPyramid {
    fn rules(self) -> TestRules {
        TestRules {
            unknown: match (self.phases, self.late) {
                (DrawPhases::Two, _) => UnknownEntities::Wait,
                (DrawPhases::One, LateEntities::Keep) => UnknownEntities::Drawn,
                (DrawPhases::One, LateEntities::Cull) => UnknownEntities::Culled,
            },
            shape: self.shape,
            detail: self.detail,
        }
    }
}

impl Strategy for DepthPyramid {
    fn name(&self) -> &str {
        "depth-pyramid"
    }

    fn summary(&self) -> &str {
        self.like.map_or("draws last frame's visible first, tests all boxes against a pyramid of its depth, and draws what it finds (Haar and Aaltonen 2015)", Rival::summary)
    }

    fn conservative(&self) -> bool {
        self.like.is_none() && self.phases == DrawPhases::Two
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
        let boxes = g.view_boxes(view, self.rules());
        let states = g.sample_counts(view);
        let known = match self.history {
            History::Bits => states.previous(),
            History::Pyramid => g.recall_by_pyramid(view, boxes),
        };
        let first = g.first_by_boxes(view, boxes, known);
        let choices = Choices::of(g, view);
        let last = g.compact(view, "last visible", choices.opaque, first);
        g.shade_indirect(view, "shade last visible", last);
        let tested = g.test_boxes(view, boxes, first, states);
        let drawn = match self.phases {
            DrawPhases::One => first,
            DrawPhases::Two => {
                let new = g.compact(view, "found visible", choices.opaque, tested.rest);
                g.shade_indirect(view, "shade found visible", new);
                g.test_drawn(view, boxes, tested);
                tested.drawn
            }
        };
        if let Some(transparent) = choices.transparent {
            let kept = g.compact(view, "visible transparent set", transparent, drawn);
            g.shade_indirect(view, "transparent", kept);
        }
        Ok(match choices.candidates {
            Some(candidates) => verdicts(g, view, candidates, drawn),
            None => VisibleSet::drawn_on_gpu(drawn),
        })
    }
}

impl Tunable for DepthPyramid {
    fn settings(&self) -> Vec<Setting> {
        describe(PARAMETERS, self)
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        assign("depth-pyramid", PARAMETERS, self, key, value)
    }

    /// From two phases to one.
    fn steps(&self) -> Vec<Step> {
        ["2", "1"]
            .map(|phases| Step::of([("phases", phases.into())]))
            .into()
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
