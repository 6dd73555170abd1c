//! The stories that the cases play, one file for each subject. A story returns the first violation.

mod cameras;
mod entities;
mod extremes;
mod gaps;
mod lenses;
mod random;
mod worlds;

use antumbra_cull::Verdicts;
use antumbra_scene::{Camera, Scene};

use super::case::Case;
use super::failure::ViolationKind;
use super::run::{CaseContext, Run, ViewCamera};

/// Plays the story of a case.
pub(super) fn play(case: Case, context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    match case {
        Case::RandomScenes => random::random_scenes(context),
        Case::Repeat => random::repeat(context),
        Case::Still => random::still(context),
        Case::Stereo => random::stereo(context),
        Case::Projections => random::projections(context),
        Case::Resize => random::resize(context),
        Case::Cut => cameras::cut(context),
        Case::InsideBox => cameras::inside_box(context),
        Case::NearPlane => cameras::near_plane(context),
        Case::Behind => cameras::behind(context),
        Case::SlotReuse => entities::slot_reuse(context),
        Case::Motion => entities::motion(context),
        Case::Empty => entities::empty(context),
        Case::Outgrow => entities::outgrow(context),
        Case::Sizes => extremes::sizes(context),
        Case::Many => extremes::many(context),
        Case::Flat => extremes::flat(context),
        Case::Worlds => worlds::worlds(context),
        Case::Lenses => lenses::lenses(context),
        Case::Gaps => gaps::gaps(context),
        Case::Custom => Err(ViolationKind::Failed(
            "this case needs a scene: call Kit::check_scene".to_owned(),
        )),
    }
}

/// Plays a scene of the caller, with one camera a view for each frame. Returns the verdicts by frame, then by view.
pub(super) fn custom(
    context: &mut CaseContext<'_>,
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
    let mut run = Run::with_views(context, scene, &names)?;
    for cameras in frames {
        let cameras: Vec<ViewCamera> = cameras
            .iter()
            .copied()
            .map(ViewCamera::continuous)
            .collect();
        run.frame_of_views(&cameras)?;
    }
    Ok(run
        .history
        .chunks(views.max(1))
        .map(<[_]>::to_vec)
        .collect())
}
