//! CHC++: hierarchical culling that relies on coherence in time. What was visible is drawn and now and then tested again; what was hidden is tested, several
//! nodes in one query.
//!
//! Mattausch, Bittner, Wimmer, *CHC++: Coherent Hierarchical Culling Revisited*, 2008, after Bittner, Wimmer, Piringer, Purgathofer, *Coherent
//! Hierarchical Culling: Hardware Occlusion Queries Made Useful*, 2004. A wait here submits what was recorded, so all that can be drawn or queried without an answer comes
//! before it, and a batch ends where the order front to back matters.

mod settings;
mod traversal;
mod visibility;

use antumbra_cull::guard::GuardOptions;
use antumbra_cull::{
    DeclareError, FrameGraph, Latency, Setting, SettingError, Step, Strategy, Tunable, Value,
    ViewNodes, VisibleSet, assign, describe,
};
use antumbra_scene::hierarchy::HierarchyShape;

use crate::traversal::{frame_late, same_frame};
use traversal::ChcTraversal;

/// The strategy `chc-plus-plus`.
#[derive(Debug, Clone, PartialEq)]
pub struct ChcPlusPlus {
    /// When the answers are used: [`Latency::SameFrame`] or [`Latency::FrameLate`].
    pub latency: Latency,
    /// How the inner nodes of the tree are made.
    pub tree: HierarchyShape,
    /// Least nodes that gather before they are queried, where so many wait: 1 to 1,000,000. What was hidden in the last frame comes on top.
    pub batch: u32,
    /// Whether nodes that will probably stay hidden share a query.
    pub multiqueries: bool,
    /// Most levels below a node whose boxes are drawn in place of its own; 0: its own box is drawn.
    pub tight_depth: u32,
    /// Most surface of the boxes below a node, as a multiple of that of its own box.
    pub tight_surface: f32,
    /// Frames for which a visible leaf is drawn without another query.
    pub visible_for: u32,
    /// Whether the first of these periods ends after a random number of frames.
    pub randomised: bool,
    /// The seed of these numbers.
    pub seed: u32,
    /// Whether a node without an answer that reaches a part of the screen where nothing was drawn is visible without a query, as in
    /// `occupancy-map`.
    pub free_screen: bool,
    /// A node with at most this many triangles is not opened: its children would cost more queries than they can save.
    pub grain: u32,
    /// Triangles that a wait must be able to save, beside 190 a query. Where all waiting nodes together hold no more, they are drawn without a
    /// query. 0: every waiting node is queried, as in the paper.
    pub worth: u32,
    /// Whether the traversal keeps a [`Sketch`](crate::Sketch) for debugging.
    pub sketch: bool,
    /// How far the eye goes a frame, for late answers that hide nothing that has come into view meanwhile.
    pub guard: GuardOptions,
}

impl Default for ChcPlusPlus {
    fn default() -> Self {
        Self {
            latency: Latency::default(),
            tree: HierarchyShape::Divided,
            batch: 50,
            multiqueries: true,
            tight_depth: 3,
            tight_surface: 1.4,
            visible_for: 5,
            randomised: true,
            seed: 0,
            free_screen: true,
            grain: 200,
            worth: 5000,
            sketch: false,
            guard: GuardOptions::OFF,
        }
    }
}

impl Strategy for ChcPlusPlus {
    fn name(&self) -> &str {
        "chc-plus-plus"
    }

    fn summary(&self) -> &str {
        "draws what was visible in the last frame, queries what was hidden, several nodes in one query (Mattausch et al. 2008)"
    }

    fn conservative(&self) -> bool {
        self.latency == Latency::SameFrame || self.guard.is_on()
    }

    fn latency(&self) -> Option<Latency> {
        Some(self.latency)
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
        let settings = self.traversal();
        Ok(match self.latency {
            Latency::FrameLate => frame_late(g, view, self.tree, settings),
            _ => same_frame::<ChcTraversal>(g, view, self.tree, settings),
        })
    }
}

impl Tunable for ChcPlusPlus {
    fn settings(&self) -> Vec<Setting> {
        describe(settings::PARAMETERS, self)
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        assign("chc-plus-plus", settings::PARAMETERS, self, key, value)
    }

    fn steps(&self) -> Vec<Step> {
        let latencies = [Latency::SameFrame, Latency::FrameLate];
        (latencies.map(|latency| Step::of([("latency", latency.word().into())]))).into()
    }
}
