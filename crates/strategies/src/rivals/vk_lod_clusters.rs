//! nvpro's vk_lod_clusters, with two passes. Source: `shaders/{culling.glsl,nvhiz-update.comp.glsl}`, `src/nvhiz_vk.{hpp,cpp}`.
//!
//! Known, read in the source: a square pyramid of a power of two, from half the image on, of which a part is in use; rectangles are scaled to that part, and clamped two texels before its end;
//! eight corners; no test across the near plane or the eye; niagara's level and its finer one; one sample of a sampler with minimum reduction; a nudge of two steps of 24 bits. Guessed: that
//! texels beyond the part in use repeat those at its edge, and that the first pass projects this frame's boxes with the previous camera.
//!
//! Different here: entities are tested, not clusters; their boxes are oriented.

use antumbra_shaders::jobs;

use super::pyramid::PyramidRule;
use super::{Design, FirstPhase, Frame, SecondPhase};

pub(super) const DESIGN: Design = Design {
    pyramid: PyramidRule::SQUARE,
    test: &jobs::rival_vk_lod_clusters::JOB,
    first: FirstPhase::Tested {
        eye: Frame::Previous,
        boxes: Frame::This,
    },
    second: SecondPhase::Test,
};
