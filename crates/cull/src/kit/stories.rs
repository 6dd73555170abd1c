//! The stories that the cases play, by what they are about.

mod cameras;
mod entities;
mod extremes;
mod runs;

use rand::SeedableRng;
use rand_pcg::Pcg32;

use super::case::Case;
use super::failure::Breach;
use super::play::Bench;

/// Plays a case to its end, or to the first thing that does not hold.
pub(super) fn play(case: Case, bench: &mut Bench<'_>) -> Result<(), Breach> {
    match case {
        Case::RandomScenes => runs::random_scenes(bench),
        Case::Repeat => runs::repeat(bench),
        Case::Still => runs::still(bench),
        Case::Stereo => runs::stereo(bench),
        Case::Cut => cameras::cut(bench),
        Case::InsideBox => cameras::inside_box(bench),
        Case::NearPlane => cameras::near_plane(bench),
        Case::Behind => cameras::behind(bench),
        Case::SlotReuse => entities::slot_reuse(bench),
        Case::Motion => entities::motion(bench),
        Case::Empty => entities::empty(bench),
        Case::Outgrow => entities::outgrow(bench),
        Case::Sizes => extremes::sizes(bench),
        Case::Many => extremes::many(bench),
        Case::Flat => extremes::flat(bench),
    }
}

/// A stream of chance for one scene of a case.
fn chance(bench: &Bench<'_>, scene: u32) -> Pcg32 {
    Pcg32::seed_from_u64(
        bench
            .kit
            .seed
            .wrapping_mul(1009)
            .wrapping_add(u64::from(scene)),
    )
}
