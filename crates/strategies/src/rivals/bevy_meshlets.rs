//! Bevy 0.20.1, meshlets. Source: `bevy_pbr/src/meshlet/cull_{shared,instances,bvh,clusters}.wesl`.
//!
//! Known, read in the source: boxes across the near plane are visible; four by four loads at a finer level than two by two would need; equal depth is occluded; what fails in the first pass is
//! tested in a second. Guessed: that the level is the finest at which four by four suffice, and that the first pass uses the previous frame's view and transforms, as for meshes.
//!
//! Different here: entities are tested, not a tree of clusters; their boxes are oriented.

use antumbra_shaders::jobs;

use super::pyramid::PyramidRule;
use super::{Design, FirstPhase, Frame, SecondPhase};

pub(super) const DESIGN: Design = Design {
    pyramid: PyramidRule::ENLARGED,
    test: &jobs::rival_bevy_meshlets::JOB,
    first: FirstPhase::Tested {
        eye: Frame::Previous,
        boxes: Frame::Previous,
    },
    second: SecondPhase::Test,
};
