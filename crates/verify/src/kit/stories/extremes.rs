//! Extremes: of size, of number, of flatness.

use glam::{DAffine3, DQuat, DVec3};
use rand::RngExt;

use super::chance;
use crate::kit::failure::ViolationKind;
use crate::kit::play::{Bench, Play};
use crate::kit::props::{Props, camera, placed, turn};

pub(super) fn sizes(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    let mut random = chance(bench, 500);
    let pixel = 1.1 / f64::from(bench.kit.size[1].max(1));
    // Of a tenth of a pixel to three, near and far; half of them behind what fills half the sky.
    for _ in 0..60 {
        let distance = 10f64.powf(random.random_range(0.5..4.0));
        let [x, y] = std::array::from_fn(|_| random.random_range(-0.6..0.6));
        let size = distance * pixel * 10f64.powf(random.random_range(-1.0..0.5));
        let centre = DVec3::new(x, y, -1.0) * distance;
        if random.random_bool(0.5) {
            props.sphere(centre, size)?;
        } else {
            props.cube(centre, DVec3::splat(size))?;
        }
    }
    props.sphere(DVec3::new(3.0, 0.0, -6.0), 6.0)?;
    // So large and far that single precision knows its place to a few metres only.
    props.cube(DVec3::new(0.0, -2e6, -4e7), DVec3::new(1e8, 1e6, 1e6))?;
    let mut play = Play::new(bench, props.scene)?;
    for step in 0..3 {
        let eye = DVec3::X * (f64::from(step) * 0.01);
        play.frame(&camera(eye, eye - DVec3::Z)?)?;
    }
    Ok(())
}

pub(super) fn many(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    let (cube, paint) = (props.shapes.cube, props.paints.opaque[3]);
    let wide = f64::from(bench.kit.many_entities.max(1)).sqrt().ceil() as u32;
    props.cube(DVec3::new(-12.0, 0.0, -20.0), DVec3::new(16.0, 40.0, 0.5))?;
    for number in 0..bench.kit.many_entities {
        let (column, row) = (number % wide, number / wide);
        let along = |i: u32| (f64::from(i) / f64::from(wide) - 0.5) * 60.0;
        let place = DVec3::new(along(column), along(row) * 0.7, -50.0);
        props.put(cube, paint, placed(place, DVec3::splat(0.3)))?;
    }
    let mut play = Play::new(bench, props.scene)?;
    let camera = camera(DVec3::ZERO, DVec3::NEG_Z)?;
    play.frame(&camera)?;
    play.frame(&camera)
}

pub(super) fn flat(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    let (shapes, paints) = (props.shapes, props.paints);
    let mut random = chance(bench, 600);
    // Squares near and far, some of a pixel or two.
    for number in 0..40 {
        let distance = 10f64.powf(random.random_range(0.5..3.0));
        let [x, y] = std::array::from_fn(|_| random.random_range(-0.6..0.6));
        let size = distance * random.random_range(0.01..0.1);
        let upright = number % 3 == 0;
        let place = DAffine3::from_scale_rotation_translation(
            DVec3::splat(size),
            if upright {
                DQuat::IDENTITY
            } else {
                turn(&mut random)
            },
            DVec3::new(x, y, -1.0) * distance,
        );
        props.put(shapes.square, paints.double_sided, place)?;
    }
    // Flattened boxes, edge on and facing; nothing but a point; triangles without area.
    let sizes = [
        DVec3::new(1.0, 0.0, 1.0),
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::ZERO,
    ];
    for (size, x) in sizes.into_iter().zip([-1.0, 0.0, 1.0]) {
        props.cube(DVec3::new(x, 0.0, -3.0), size)?;
    }
    let place = placed(DVec3::new(0.0, 1.0, -4.0), DVec3::ONE);
    props.put(shapes.collapsed, paints.double_sided, place)?;
    // A line and a point: boxes that cover no pixel at all.
    let (line, point) = (DVec3::new(0.0, -1.2, -4.0), DVec3::new(0.3, 1.3, -4.0));
    props.put(shapes.line, paints.opaque[1], placed(line, DVec3::ONE))?;
    props.put(shapes.point, paints.opaque[2], placed(point, DVec3::ONE))?;
    // Twins in one place, and one flat on another's face: whoever draws last owns the pixels.
    let coplanar = [
        (shapes.cube, DVec3::new(1.2, -0.8, -3.5), 0.7),
        (shapes.cube, DVec3::new(1.2, -0.8, -3.5), 0.7),
        (shapes.cube, DVec3::new(-1.2, -0.8, -4.0), 1.0),
        (shapes.square, DVec3::new(-1.2, -0.8, -3.5), 0.5),
    ];
    for (mesh, centre, size) in coplanar {
        props.put(mesh, paints.unlit, placed(centre, DVec3::splat(size)))?;
    }
    let mut play = Play::new(bench, props.scene)?;
    for step in 0..3 {
        let eye = DVec3::new(f64::from(step) * 0.02, 0.0, 0.0);
        play.frame(&camera(eye, eye - DVec3::Z)?)?;
    }
    Ok(())
}
