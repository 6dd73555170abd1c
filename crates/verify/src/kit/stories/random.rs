//! Stories on random scenes: a moving camera, the same input twice, a still camera, two views, and two projections.

use antumbra_cull::Verdicts;
use antumbra_scene::{Camera, Projection};
use glam::DVec3;

use crate::kit::failure::ViolationKind;
use crate::kit::run::{CaseContext, Run, ViewCamera};
use crate::kit::test_scene::{TestScene, camera};

/// Number of entities in each scene, beside its two walls and nested spheres.
const ENTITIES: u32 = 36;

/// A camera on a circle around the scene, at an angle in radians.
fn orbit(angle: f64) -> Result<Camera, ViolationKind> {
    let eye = DVec3::new(angle.sin() * 7.5, 1.5 + angle.cos(), angle.cos() * 7.5);
    Ok(camera(eye, DVec3::ZERO)?)
}

pub(super) fn random_scenes(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    for number in 0..context.kit.random_scenes {
        let mut test = TestScene::new()?;
        test.scatter(&mut context.random(number), ENTITIES)?;
        let mut run = Run::new(context, test.scene)?;
        for step in 0..3 {
            run.frame(&orbit(f64::from(number) * 1.9 + f64::from(step) * 0.07)?)?;
        }
    }
    Ok(())
}

pub(super) fn resize(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    test.scatter(&mut context.random(300), ENTITIES)?;
    let [width, height] = context.kit.size;
    let mut run = Run::new(context, test.scene)?;
    let mut angle = 0.0;
    // Larger, smaller, with other proportions, and back.
    for size in [
        [width, height],
        [width + width / 2, height + height / 2],
        [width.div_ceil(3), height.div_ceil(3)],
        [height, width],
        [width, height],
    ] {
        run.resize(size)?;
        for _ in 0..2 {
            run.frame(&orbit(angle)?)?;
            angle += 0.07;
        }
    }
    Ok(())
}

pub(super) fn repeat(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let first = repeated(context)?;
    if first == repeated(context)? {
        Ok(())
    } else {
        Err(ViolationKind::NotRepeatable)
    }
}

/// Runs the story of [`repeat`] once.
fn repeated(context: &mut CaseContext<'_>) -> Result<Vec<Verdicts>, ViolationKind> {
    let mut test = TestScene::new()?;
    test.scatter(&mut context.random(100), ENTITIES)?;
    let mut run = Run::new(context, test.scene)?;
    for step in 0..3 {
        run.frame(&orbit(f64::from(step) * 0.2)?)?;
    }
    run.cut(&orbit(3.0)?)?;
    run.frame(&orbit(3.1)?)?;
    Ok(run.history)
}

pub(super) fn still(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    test.scatter(&mut context.random(200), ENTITIES)?;
    let settle = context.kit.settle_frames;
    let mut run = Run::new(context, test.scene)?;
    // The answers of the first frame are those of another camera.
    run.frame(&orbit(0.4)?)?;
    for _ in 0..settle + 2 {
        run.still(&orbit(0.6)?)?;
    }
    Ok(())
}

pub(super) fn stereo(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    test.scatter(&mut context.random(300), ENTITIES)?;
    let mut run = Run::with_views(context, test.scene, &["left", "right"])?;
    for step in 0..3 {
        let angle = 0.9 + f64::from(step) * 0.05;
        // The views are far apart, so that they differ. Only the right one jumps.
        let right = if step == 2 {
            ViewCamera::cut(orbit(angle + 2.5)?)
        } else {
            ViewCamera::continuous(orbit(angle + 0.3)?)
        };
        run.frame_of_views(&[ViewCamera::continuous(orbit(angle)?), right])?;
    }
    Ok(())
}

pub(super) fn projections(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    test.scatter(&mut context.random(400), ENTITIES)?;
    let mut run = Run::with_views(context, test.scene, &["main", "plan"])?;
    for step in 0..3 {
        let angle = 0.5 + f64::from(step) * 0.06;
        let main = orbit(angle)?;
        let plan = Camera {
            projection: Projection::Orthographic {
                height: 9.0,
                near: 0.05,
                far: 100.0,
            },
            ..orbit(angle + 0.8)?
        };
        run.frame_of_views(&[ViewCamera::continuous(main), ViewCamera::continuous(plan)])?;
    }
    Ok(())
}
