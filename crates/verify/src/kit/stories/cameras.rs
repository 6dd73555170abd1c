//! Stories about where the camera is: behind a wall after a cut, inside a box, close to an entity, turned away from all of them.

use glam::DVec3;

use crate::kit::failure::ViolationKind;
use crate::kit::run::{CaseContext, Run};
use crate::kit::test_scene::{TestScene, camera, camera_with, placed};

pub(super) fn cut(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    test.cube(DVec3::ZERO, DVec3::new(6.0, 4.0, 0.2))?;
    for side in [-1.0, 1.0] {
        for column in -2..=2 {
            let place = DVec3::new(f64::from(column), 0.2, side);
            test.sphere(place, 0.7)?;
        }
    }
    let mut run = Run::new(context, test.scene)?;
    let front = camera(DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO)?;
    let back = camera(DVec3::new(0.0, 0.0, -4.0), DVec3::ZERO)?;
    // Three frames, so that answers are in use; then cuts to the back and again.
    for _ in 0..3 {
        run.frame(&front)?;
    }
    run.cut(&back)?;
    run.frame(&back)?;
    run.cut(&front)?;
    run.cut(&back)
}

pub(super) fn inside_box(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    let room = placed(DVec3::ZERO, DVec3::new(6.0, 4.0, 8.0));
    test.add(test.meshes.cube, test.materials.double_sided, room)?;
    test.cube(DVec3::new(0.5, -1.0, -2.0), DVec3::splat(1.0))?;
    test.sphere(DVec3::new(0.5, -1.0, -3.3), 0.6)?;
    test.sphere(DVec3::new(0.0, 0.0, -9.0), 2.0)?;
    let mut run = Run::new(context, test.scene)?;
    for step in 0..4 {
        let eye = DVec3::new(0.2, 0.1, 2.0 - f64::from(step) * 0.3);
        run.frame(&camera(eye, DVec3::new(0.3, -0.4, -4.0))?)?;
    }
    // Out through the wall behind the camera, and back in.
    run.frame(&camera(DVec3::new(0.2, 0.1, 5.5), DVec3::ZERO)?)?;
    run.frame(&camera(DVec3::new(0.2, 0.1, 3.8), DVec3::ZERO)?)
}

pub(super) fn near_plane(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    // The box, with its front faces, starts in front of the near plane; the ramp inside it is beyond the near plane and visible.
    let ramp = placed(DVec3::new(0.0, 0.0, -1.2), DVec3::splat(3.0));
    test.add(test.meshes.ramp, test.materials.opaque[0], ramp)?;
    test.sphere(DVec3::new(0.4, 0.2, -5.0), 1.0)?;
    // A bar along the viewing direction, clipped by the near plane.
    test.cube(DVec3::new(-0.5, -0.4, -0.6), DVec3::new(0.1, 0.1, 3.0))?;
    let mut run = Run::new(context, test.scene)?;
    for step in 0..4 {
        let eye = DVec3::new(0.0, 0.0, 1.0 - f64::from(step) * 0.25);
        run.frame(&camera_with(eye, DVec3::new(0.0, 0.0, -5.0), 0.8)?)?;
    }
    // The eye is in the corner of a ball's box and outside of the ball, which has more triangles than a box: all faces of the box are seen from behind.
    let mut test = TestScene::new()?;
    test.sphere(DVec3::new(2.0, 2.0, -1.6), 6.0)?;
    test.sphere(DVec3::new(-1.0, -0.5, -5.0), 1.0)?;
    let mut run = Run::new(context, test.scene)?;
    for step in 0..4 {
        let eye = DVec3::new(0.0, 0.0, 1.0 - f64::from(step) * 0.25);
        run.frame(&camera_with(eye, DVec3::new(1.0, 1.0, -5.0), 0.1)?)?;
    }
    Ok(())
}

pub(super) fn behind(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    for column in -3..=3 {
        test.sphere(DVec3::new(f64::from(column), 0.0, 6.0), 0.8)?;
        test.cube(DVec3::new(f64::from(column), 1.0, 9.0), DVec3::splat(0.5))?;
    }
    let mut run = Run::new(context, test.scene)?;
    let away = camera(DVec3::ZERO, DVec3::NEG_Z)?;
    for _ in 0..3 {
        run.frame(&away)?;
    }
    // The camera turns around without a cut: all entities are new in the frustum.
    run.frame(&camera(DVec3::ZERO, DVec3::Z)?)?;
    run.frame(&away)
}
