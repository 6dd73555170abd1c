//! Scenes of chance: seen in passing, seen twice, stared at, and seen with two eyes.

use antumbra_scene::Camera;
use glam::DVec3;

use super::chance;
use crate::kit::failure::ViolationKind;
use crate::kit::play::{Bench, Play};
use crate::kit::props::{Props, camera};
use antumbra_cull::Verdicts;

const ENTITIES: u32 = 36;

/// On a circle around the scene, at an angle in radians.
fn orbit(angle: f64) -> Result<Camera, ViolationKind> {
    let eye = DVec3::new(angle.sin() * 7.5, 1.5 + angle.cos(), angle.cos() * 7.5);
    Ok(camera(eye, DVec3::ZERO)?)
}

pub(super) fn random_scenes(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    for number in 0..bench.kit.random_scenes {
        let mut props = Props::new()?;
        props.strew(&mut chance(bench, number), ENTITIES)?;
        let mut play = Play::new(bench, props.scene)?;
        for step in 0..3 {
            play.frame(&orbit(f64::from(number) * 1.9 + f64::from(step) * 0.07)?)?;
        }
    }
    Ok(())
}

pub(super) fn repeat(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let first = repeated(bench)?;
    if first == repeated(bench)? {
        Ok(())
    } else {
        Err(ViolationKind::NotRepeatable)
    }
}

fn repeated(bench: &mut Bench<'_>) -> Result<Vec<Verdicts>, ViolationKind> {
    let mut props = Props::new()?;
    props.strew(&mut chance(bench, 100), ENTITIES)?;
    let mut play = Play::new(bench, props.scene)?;
    for step in 0..3 {
        play.frame(&orbit(f64::from(step) * 0.2)?)?;
    }
    play.cut(&orbit(3.0)?)?;
    play.frame(&orbit(3.1)?)?;
    Ok(play.history)
}

pub(super) fn still(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    props.strew(&mut chance(bench, 200), ENTITIES)?;
    let settle = bench.kit.settle_frames;
    let mut play = Play::new(bench, props.scene)?;
    // From a past of other answers into stillness.
    play.frame(&orbit(0.4)?)?;
    for _ in 0..settle + 2 {
        play.still(&orbit(0.6)?)?;
    }
    Ok(())
}

pub(super) fn stereo(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    props.strew(&mut chance(bench, 300), ENTITIES)?;
    let mut play = Play::with_views(bench, props.scene, &["left", "right"])?;
    for step in 0..3 {
        let angle = 0.9 + f64::from(step) * 0.05;
        // Wide apart, so that the eyes do not see the same; only the right one jumps.
        let jumps = step == 2;
        let right = orbit(angle + if jumps { 2.5 } else { 0.3 })?;
        play.frames(&[(orbit(angle)?, false), (right, jumps)])?;
    }
    Ok(())
}
