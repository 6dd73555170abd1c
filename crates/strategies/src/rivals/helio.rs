//! Helio, by Far Beyond Pulsar. Source: `helio-pass-hiz/{src/lib.rs,shaders/hiz_build.wgsl}`, `helio-pass-occlusion-cull/shaders/occlusion_cull.wgsl`.
//!
//! Known, read in the source: levels are halved and rounded down; the sphere's rectangle is its middle and its radius over w; four points without a filter; the depth of the point nearest to
//! the eye; the bias; one phase, which tests this frame's spheres by this frame's camera against the previous frame's pyramid. Its frame 0 is not tested: here an empty pyramid hides
//! nothing, which is the same.
//!
//! Different here: depth is reversed here and forward there; spheres are derived from boxes and from how round their meshes are; its baked visible sets are left out. Of several samples a pixel the farthest
//! is taken.

use antumbra_shaders::jobs;

use super::pyramid::PyramidRule;
use super::{Design, FirstPhase, Frame, SecondPhase};

pub(super) const DESIGN: Design = Design {
    pyramid: PyramidRule::ROUNDED_DOWN,
    test: &jobs::rival_helio::JOB,
    first: FirstPhase::Tested {
        eye: Frame::This,
        boxes: Frame::This,
    },
    second: SecondPhase::None,
};
