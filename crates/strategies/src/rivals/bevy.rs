//! Bevy 0.20.1, meshes. Source: `bevy_pbr/src/render/{mesh_preprocess,occlusion_culling}.wesl`, `bevy_core_pipeline/src/mip_generation/experimental`.
//!
//! Known, read in the source: the pyramid's size and gathers, with a loop over samples; the eight corners; the level; four loads; the clamp of the nearest depth; strict comparison, so that equal
//! depth is visible; an early phase with the previous frame's view, transforms and pyramid; a late phase that tests what failed. A load beyond the image is taken to answer 0, as wgpu's
//! bounds checks have it on Vulkan.
//!
//! Different here: its pyramid takes two dispatches, this one a dispatch a large level; a mesh that fails is queued there, and marked here. An entity that is new in its slot is tested early
//! with the previous box of the slot; there with its own. Either is only a guess, which the late phase corrects.

use antumbra_shaders::jobs;

use super::pyramid::PyramidRule;
use super::{Design, FirstPhase, Frame, SecondPhase};

pub(super) const DESIGN: Design = Design {
    pyramid: PyramidRule::ENLARGED,
    test: &jobs::rival_bevy::JOB,
    first: FirstPhase::Tested {
        eye: Frame::Previous,
        boxes: Frame::Previous,
    },
    second: SecondPhase::Test,
};
