//! Yardsticks for study: the occlusion tests of other engines, built again from what is published of them, on this graph. None of them claims to be conservative, and none is meant to be used;
//! `docs/rivals.md` has what each of them gets right and wrong.
//!
//! A rival is a [`Design`]: how its depth pyramid is made, what it draws first, and whether it looks again. Each has a file, whose head names its source and says what is known of it and what is
//! a guess, and a shader `rival_*.wgsl` with its test. All share what is not theirs: the frustum test, the boxes, the drawing, and the rule that an entity across the near plane is drawn.

mod bevy;
mod bevy_meshlets;
mod eye;
mod helio;
mod niagara;
mod nodes;
mod pyramid;
mod unity;
mod vk_lod_clusters;

use antumbra_cull::{DeclareError, FrameGraph, ViewNodes, VisibleSet};
use antumbra_graph::Buffer;
use antumbra_shaders::Job;

use crate::found_on_gpu::{ExemptEntities, opaque, shade_found_transparent, verdicts};
use nodes::Nodes;
use pyramid::PyramidRule;

/// An engine whose occlusion test is built again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rival {
    /// Bevy 0.20.1, meshes.
    Bevy,
    /// Bevy 0.20.1, meshlets; here by entity.
    BevyMeshlets,
    /// niagara.
    Niagara,
    /// Helio.
    Helio,
    /// Unity's GPU Resident Drawer.
    Unity,
    /// nvpro's vk_lod_clusters; here by entity.
    VkLodClusters,
}

/// How a rival works.
struct Design {
    pyramid: PyramidRule,
    /// The shader with its test.
    test: &'static Job,
    first: FirstPhase,
    second: SecondPhase,
}

/// What a rival draws before it has a depth of this frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FirstPhase {
    /// What the previous frame's test found, without a test.
    PreviouslyFound,
    /// What a test against the previous frame's pyramid lets through.
    Tested {
        /// By which camera boxes are projected.
        eye: Frame,
        /// Which boxes are tested.
        boxes: Frame,
    },
}

/// Of which frame a value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Frame {
    Previous,
    This,
}

/// What follows the first phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SecondPhase {
    /// Nothing: what is missing is missing for a frame.
    None,
    /// A test against the depth of what was drawn, and a drawing of what it finds.
    Test,
}

impl Rival {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Bevy,
        Self::BevyMeshlets,
        Self::Niagara,
        Self::Helio,
        Self::Unity,
        Self::VkLodClusters,
    ];

    /// Its name as a setting.
    pub fn word(self) -> &'static str {
        match self {
            Self::Bevy => "bevy",
            Self::BevyMeshlets => "bevy-meshlets",
            Self::Niagara => "niagara",
            Self::Helio => "helio",
            Self::Unity => "unity",
            Self::VkLodClusters => "vk_lod_clusters",
        }
    }

    /// What it is, in a line.
    pub fn summary(self) -> &'static str {
        match self {
            Self::Bevy => {
                "a yardstick for study, not conservative: the test of Bevy 0.20.1's meshes"
            }
            Self::BevyMeshlets => {
                "a yardstick for study, not conservative: the test of Bevy 0.20.1's meshlets"
            }
            Self::Niagara => "a yardstick for study, not conservative: niagara's test",
            Self::Helio => "a yardstick for study, not conservative: Helio's test",
            Self::Unity => {
                "a yardstick for study, not conservative: the test of Unity's GPU Resident Drawer"
            }
            Self::VkLodClusters => {
                "a yardstick for study, not conservative: the test of nvpro's vk_lod_clusters"
            }
        }
    }

    fn design(self) -> Design {
        match self {
            Self::Bevy => bevy::DESIGN,
            Self::BevyMeshlets => bevy_meshlets::DESIGN,
            Self::Niagara => niagara::DESIGN,
            Self::Helio => helio::DESIGN,
            Self::Unity => unity::DESIGN,
            Self::VkLodClusters => vk_lod_clusters::DESIGN,
        }
    }
}

/// Adds a rival's nodes to a view.
pub(crate) fn declare(
    rival: Rival,
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
) -> Result<VisibleSet, DeclareError> {
    let design = rival.design();
    let candidates = g.in_frustum(view);
    let found = g.sample_counts(view);
    let nodes = Nodes::new(g, view, &design);
    let first = match design.first {
        FirstPhase::PreviouslyFound => found.previous(),
        FirstPhase::Tested { eye, boxes } => nodes.test_first(g, view, eye, boxes),
    };
    let all = opaque(g, view, "first", candidates, ExemptEntities::Included);
    let shaded = g.compact(view, "first", all, first);
    g.shade_indirect(view, "shade first", shaded);
    let seen = match design.second {
        SecondPhase::None => Seen {
            found: first,
            drawn: first,
        },
        SecondPhase::Test => {
            let (seen, besides) = nodes.test_rest(g, view, first, found);
            let left = opaque(g, view, "rest", candidates, ExemptEntities::LeftOut);
            let shaded = g.compact(view, "rest", left, besides);
            g.shade_indirect(view, "shade rest", shaded);
            seen
        }
    };
    if matches!(design.first, FirstPhase::Tested { .. }) {
        nodes.keep_pyramid(g, view);
    }
    shade_found_transparent(g, view, candidates, seen.found);
    Ok(verdicts(g, view, candidates, seen.drawn))
}

/// What is known after the last phase: a u32 a slot, 1 or 0.
struct Seen {
    /// Visible.
    found: Buffer,
    /// Drawn by the first phase, or visible.
    drawn: Buffer,
}
