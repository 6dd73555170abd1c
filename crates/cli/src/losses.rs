//! What an image lacks: the visible entities that a strategy did not draw, in a sentence a view.

use antumbra::verify::{Differences, EntitySet, IdBuffer, Oracle};

use crate::drawn_pose::DrawnPose;
use crate::failure::Failure;

/// The most entities that a sentence names.
const NAMED: usize = 3;

/// A sentence for each view that lacks a visible entity. Nothing is drawn for a yardstick.
///
/// # Errors
/// What stopped the oracle.
pub fn losses(pose: &DrawnPose) -> Result<Vec<String>, Failure> {
    let strategy = pose.stage.strategy();
    if strategy.role().is_yardstick() {
        return Ok(Vec::new());
    }
    let mut oracle = Oracle::new(&pose.scene, pose.size).with_samples(pose.samples);
    let mut sentences = Vec::new();
    for (view, camera) in pose.cameras.iter().enumerate() {
        let verdicts = pose.stage.verdicts(view, &pose.scene)?;
        let reference = oracle.render(&pose.scene, camera, EntitySet::InFrustum)?;
        pose.watch.sign();
        let found = oracle.differences(&pose.scene, camera, &reference, &verdicts)?;
        pose.watch.sign();
        let eye = match (pose.cameras.len(), view) {
            (1, _) => "",
            (_, 0) => ", left eye",
            _ => ", right eye",
        };
        let sentence = sentence(pose, &reference, &found);
        sentences.extend(sentence.map(|words| format!("{}{eye}: {words}", strategy.name())));
    }
    Ok(sentences)
}

/// What one view lacks; `None` where nothing is wrong.
fn sentence(pose: &DrawnPose, reference: &IdBuffer, found: &Differences) -> Option<String> {
    let wrong = found.wrong_pixels();
    let percent = |of: usize| {
        let percent = (100.0 * wrong as f64 / of.max(1) as f64).min(100.0);
        // Two digits that are not zero, however few pixels are wrong.
        let decimals = (1.0 - percent.log10().floor()).clamp(0.0, 9.0) as usize;
        format!("{percent:.decimals$} %")
    };
    let (wrong_pixels, are) = match wrong {
        1 => ("1 pixel".to_owned(), "is"),
        _ => (format!("{wrong} pixels"), "are"),
    };
    let pixels = format!(
        "{wrong_pixels} {are} wrong, {} of the image and {} of the pixels that entities own",
        percent(reference.pixels().count()),
        percent(reference.owned_pixels()),
    );
    let missing = found.false_culls();
    if missing == 0 {
        return (wrong > 0).then_some(pixels);
    }
    let samples = reference.samples_by_slot();
    let mut lost: Vec<u32> = (found.undrawn.iter().copied())
        .filter(|slot| found.tied.binary_search(slot).is_err())
        .collect();
    lost.sort_by_key(|slot| std::cmp::Reverse(samples.get(*slot as usize).copied()));
    let occupant = |slot: u32| Some(pose.scene.table().occupant(slot)?.key);
    let named: Vec<String> = (lost.iter().take(NAMED))
        .filter_map(|slot| Some(pose.host.describe(occupant(*slot)?)))
        .collect();
    let more = match missing > named.len() {
        true => ", ...",
        false => "",
    };
    Some(format!(
        "{missing} of {} visible entities are not drawn ({}{more}); {pixels}",
        reference.owners().len(),
        named.join(", "),
    ))
}
