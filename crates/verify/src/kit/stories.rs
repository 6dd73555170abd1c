//! The stories that the cases play, by what they are about.

mod cameras;
mod entities;
mod extremes;
mod gaps;
mod lenses;
mod runs;
mod worlds;

use antumbra_scene::{Camera, Scene};
use rand::SeedableRng;
use rand_pcg::Pcg32;

use super::case::Case;
use super::failure::ViolationKind;
use super::play::{Bench, Play};
use antumbra_cull::Verdicts;

/// Plays a case to its end, or to the first thing that does not hold.
pub(super) fn play(case: Case, bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
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
        Case::Worlds => worlds::worlds(bench),
        Case::Lenses => lenses::lenses(bench),
        Case::Gaps => gaps::gaps(bench),
        Case::Custom => Err(ViolationKind::Failed(
            "this case needs a scene: play it with Kit::check_scene".to_owned(),
        )),
    }
}

/// Plays somebody's scene, a camera a view and frame; the verdicts by frame and view.
pub(super) fn own(
    bench: &mut Bench<'_>,
    scene: Scene,
    frames: &[Vec<Camera>],
) -> Result<Vec<Vec<Verdicts>>, ViolationKind> {
    let views = frames.first().map_or(0, Vec::len);
    let names: Vec<String> = match views {
        1 => vec!["main".to_owned()],
        2 => vec!["left".to_owned(), "right".to_owned()],
        many => (0..many).map(|view| format!("view {view}")).collect(),
    };
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut play = Play::with_views(bench, scene, &names)?;
    for cameras in frames {
        let cameras: Vec<(Camera, bool)> = cameras.iter().map(|one| (*one, false)).collect();
        play.frames(&cameras)?;
    }
    Ok(play
        .history
        .chunks(views.max(1))
        .map(<[_]>::to_vec)
        .collect())
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
