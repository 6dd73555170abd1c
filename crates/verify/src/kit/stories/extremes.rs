//! Stories about extremes: of size, of number, of flatness.

use glam::{DAffine3, DQuat, DVec3};
use rand::RngExt;

use crate::kit::failure::ViolationKind;
use crate::kit::run::{CaseContext, Run};
use crate::kit::test_scene::{TestScene, camera, placed, random_rotation};

pub(super) fn sizes(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    let mut random = context.random(500);
    let pixel = 1.1 / f64::from(context.kit.size[1].max(1));
    // From a tenth of a pixel to three pixels, near and far; half of them behind the sphere that fills half the sky.
    for _ in 0..60 {
        let distance = 10f64.powf(random.random_range(0.5..4.0));
        let [x, y] = std::array::from_fn(|_| random.random_range(-0.6..0.6));
        let size = distance * pixel * 10f64.powf(random.random_range(-1.0..0.5));
        let centre = DVec3::new(x, y, -1.0) * distance;
        if random.random_bool(0.5) {
            test.sphere(centre, size)?;
        } else {
            test.cube(centre, DVec3::splat(size))?;
        }
    }
    test.sphere(DVec3::new(3.0, 0.0, -6.0), 6.0)?;
    // So large and far away that single precision places it only to within a few metres.
    test.cube(DVec3::new(0.0, -2e6, -4e7), DVec3::new(1e8, 1e6, 1e6))?;
    let mut run = Run::new(context, test.scene)?;
    for step in 0..3 {
        let eye = DVec3::X * (f64::from(step) * 0.01);
        run.frame(&camera(eye, eye - DVec3::Z)?)?;
    }
    Ok(())
}

pub(super) fn many(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    let (cube, material) = (test.meshes.cube, test.materials.opaque[3]);
    let columns = f64::from(context.kit.many_entities.max(1)).sqrt().ceil() as u32;
    test.cube(DVec3::new(-12.0, 0.0, -20.0), DVec3::new(16.0, 40.0, 0.5))?;
    for number in 0..context.kit.many_entities {
        let (column, row) = (number % columns, number / columns);
        let along = |i: u32| (f64::from(i) / f64::from(columns) - 0.5) * 60.0;
        let place = DVec3::new(along(column), along(row) * 0.7, -50.0);
        test.add(cube, material, placed(place, DVec3::splat(0.3)))?;
    }
    let mut run = Run::new(context, test.scene)?;
    let camera = camera(DVec3::ZERO, DVec3::NEG_Z)?;
    run.frame(&camera)?;
    run.frame(&camera)
}

pub(super) fn flat(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    let (meshes, materials) = (test.meshes, test.materials);
    let mut random = context.random(600);
    // Squares near and far, some as small as a pixel or two.
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
                random_rotation(&mut random)
            },
            DVec3::new(x, y, -1.0) * distance,
        );
        test.add(meshes.square, materials.double_sided, place)?;
    }
    // Flat boxes, edge on and facing the camera; a box shrunk to a point; triangles without area.
    let sizes = [
        DVec3::new(1.0, 0.0, 1.0),
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::ZERO,
    ];
    for (size, x) in sizes.into_iter().zip([-1.0, 0.0, 1.0]) {
        test.cube(DVec3::new(x, 0.0, -3.0), size)?;
    }
    let place = placed(DVec3::new(0.0, 1.0, -4.0), DVec3::ONE);
    test.add(meshes.collapsed, materials.double_sided, place)?;
    // A line and a point: their boxes cover no pixel.
    let (line, point) = (DVec3::new(0.0, -1.2, -4.0), DVec3::new(0.3, 1.3, -4.0));
    test.add(meshes.line, materials.opaque[1], placed(line, DVec3::ONE))?;
    test.add(meshes.point, materials.opaque[2], placed(point, DVec3::ONE))?;
    // Coplanar twins, and a square on the face of a box: the entity that is drawn last owns the pixels.
    let coplanar = [
        (meshes.cube, DVec3::new(1.2, -0.8, -3.5), 0.7),
        (meshes.cube, DVec3::new(1.2, -0.8, -3.5), 0.7),
        (meshes.cube, DVec3::new(-1.2, -0.8, -4.0), 1.0),
        (meshes.square, DVec3::new(-1.2, -0.8, -3.5), 0.5),
    ];
    for (mesh, centre, size) in coplanar {
        test.add(mesh, materials.unlit, placed(centre, DVec3::splat(size)))?;
    }
    let mut run = Run::new(context, test.scene)?;
    for step in 0..3 {
        let eye = DVec3::new(f64::from(step) * 0.02, 0.0, 0.0);
        run.frame(&camera(eye, eye - DVec3::Z)?)?;
    }
    Ok(())
}
