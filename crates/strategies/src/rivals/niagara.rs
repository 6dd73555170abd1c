//! niagara, by Arseny Kapoulkine. Source: `src/shaders/{drawcull,clustercull,depthreduce}.comp.glsl`, `math.h`, `src/niagara.cpp`.
//!
//! Known, read in the source: the pyramid's size, a sample of a sampler with minimum reduction for a texel; the exact rectangle of a sphere; the level and the finer one; one sample; a sphere across
//! the near plane is visible; a bit for what was drawn in the previous frame, drawn without a test, and a test of everything afterwards. The comparison is strict as far as is remembered.
//!
//! Different here: its spheres are the meshes' own; these are derived from boxes and from how round their meshes are. It has perspective cameras on the axis alone: in all other views
//! everything in the frustum is drawn. It does not draw with several samples a pixel: the farthest is taken here.

use antumbra_shaders::jobs;

use super::pyramid::PyramidRule;
use super::{Design, FirstPhase, SecondPhase};

pub(super) const DESIGN: Design = Design {
    pyramid: PyramidRule::SAMPLED,
    test: &jobs::rival_niagara::JOB,
    first: FirstPhase::PreviouslyFound,
    second: SecondPhase::Test,
};
