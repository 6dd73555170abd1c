//! Unity's GPU Resident Drawer, its newest test. Source: `com.unity.render-pipelines.core/Runtime/GPUDriven`, `OcclusionCullingCommon.hlsl` and `InstanceOcclusionCuller.cs`.
//!
//! Known, read in the source: a pyramid from an eighth of the width and height on, eight levels, rounded up; eight corners; visible where a corner could reach the eye's plane; the level for the larger
//! side, one coarser where four texels would not cover it; strict comparison, after a slack of 1/256; too large is visible; the previous frame's occluders first, then a test of what they
//! hid against this frame's. Guessed: that the first test projects this frame's boxes with the previous camera, and what the slack is in a parallel view.
//!
//! Different here: no silhouette planes, one view a pyramid.

use antumbra_shaders::jobs;

use super::pyramid::PyramidRule;
use super::{Design, FirstPhase, Frame, SecondPhase};

pub(super) const DESIGN: Design = Design {
    pyramid: PyramidRule::EIGHTHS,
    test: &jobs::rival_unity::JOB,
    first: FirstPhase::Tested {
        eye: Frame::Previous,
        boxes: Frame::This,
    },
    second: SecondPhase::Test,
};
