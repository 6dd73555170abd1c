//! Where cameras stand and jump: to the other side, inside of things, right in front of them, away from them.

use glam::DVec3;

use crate::kit::failure::ViolationKind;
use crate::kit::play::{Bench, Play};
use crate::kit::props::{Props, camera, camera_with, placed};

pub(super) fn cut(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    props.cube(DVec3::ZERO, DVec3::new(6.0, 4.0, 0.2))?;
    for side in [-1.0, 1.0] {
        for column in -2..=2 {
            let place = DVec3::new(f64::from(column), 0.2, side);
            props.sphere(place, 0.7)?;
        }
    }
    let mut play = Play::new(bench, props.scene)?;
    let front = camera(DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO)?;
    let back = camera(DVec3::new(0.0, 0.0, -4.0), DVec3::ZERO)?;
    // Long enough for answers to be in use, then there and back again.
    for _ in 0..3 {
        play.frame(&front)?;
    }
    play.cut(&back)?;
    play.frame(&back)?;
    play.cut(&front)?;
    play.cut(&back)
}

pub(super) fn inside_box(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    let room = placed(DVec3::ZERO, DVec3::new(6.0, 4.0, 8.0));
    props.put(props.shapes.cube, props.paints.double_sided, room)?;
    props.cube(DVec3::new(0.5, -1.0, -2.0), DVec3::splat(1.0))?;
    props.sphere(DVec3::new(0.5, -1.0, -3.3), 0.6)?;
    props.sphere(DVec3::new(0.0, 0.0, -9.0), 2.0)?;
    let mut play = Play::new(bench, props.scene)?;
    for step in 0..4 {
        let eye = DVec3::new(0.2, 0.1, 2.0 - f64::from(step) * 0.3);
        play.frame(&camera(eye, DVec3::new(0.3, -0.4, -4.0))?)?;
    }
    // Out through the wall behind, and back in.
    play.frame(&camera(DVec3::new(0.2, 0.1, 5.5), DVec3::ZERO)?)?;
    play.frame(&camera(DVec3::new(0.2, 0.1, 3.8), DVec3::ZERO)?)
}

pub(super) fn near_plane(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    // Its box begins before the near plane, and its front faces with it; the ramp inside lies beyond, in plain sight.
    let ramp = placed(DVec3::new(0.0, 0.0, -1.2), DVec3::splat(3.0));
    props.put(props.shapes.ramp, props.paints.opaque[0], ramp)?;
    props.sphere(DVec3::new(0.4, 0.2, -5.0), 1.0)?;
    // A bar along the view, cut by the near plane.
    props.cube(DVec3::new(-0.5, -0.4, -0.6), DVec3::new(0.1, 0.1, 3.0))?;
    let mut play = Play::new(bench, props.scene)?;
    for step in 0..4 {
        let eye = DVec3::new(0.0, 0.0, 1.0 - f64::from(step) * 0.25);
        play.frame(&camera_with(eye, DVec3::new(0.0, 0.0, -5.0), 0.8)?)?;
    }
    Ok(())
}

pub(super) fn behind(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    for column in -3..=3 {
        props.sphere(DVec3::new(f64::from(column), 0.0, 6.0), 0.8)?;
        props.cube(DVec3::new(f64::from(column), 1.0, 9.0), DVec3::splat(0.5))?;
    }
    let mut play = Play::new(bench, props.scene)?;
    let away = camera(DVec3::ZERO, DVec3::NEG_Z)?;
    for _ in 0..3 {
        play.frame(&away)?;
    }
    // Turning around, no cut: all are new in the frustum.
    play.frame(&camera(DVec3::ZERO, DVec3::Z)?)?;
    play.frame(&away)
}
