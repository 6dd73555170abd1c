//! The story about the limit between covered and visible: a wall exactly as large as what it hides, a hole of one pixel, and grains smaller
//! than a pixel that close a surface together.

use antumbra_scene::{Camera, Projection};
use glam::DVec3;

use crate::kit::failure::ViolationKind;
use crate::kit::run::{CaseContext, Run};
use crate::kit::test_scene::TestScene;

pub(super) fn gaps(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let [width, height] = context.kit.size.map(f64::from);
    // One metre a pixel, with the origin between pixels.
    let projection = Projection::Orthographic {
        height,
        near: 0.0,
        far: 100.0,
    };
    let mut test = TestScene::new()?;
    // On the left, a wall exactly as large as the box that it hides.
    let covered = (height / 3.0).floor();
    let left = -(width / 4.0).floor();
    test.cube(
        DVec3::new(left, 0.0, -20.0),
        DVec3::new(covered, covered, 1.0),
    )?;
    test.cube(
        DVec3::new(left, 0.0, -40.0),
        DVec3::new(covered, covered, 1.0),
    )?;
    // On the right, four walls that leave a hole of one pixel, and a sphere behind them.
    let right = (width / 4.0).floor();
    let arm = covered * 0.5;
    for (x, y, wide, high) in [
        (-arm * 0.5, 0.5, arm, 2.0 * arm),
        (1.0 + arm * 0.5, 0.5, arm, 2.0 * arm),
        (0.5, -arm * 0.5, 1.0, arm),
        (0.5, 1.0 + arm * 0.5, 1.0, arm),
    ] {
        test.cube(DVec3::new(right + x, y, -20.0), DVec3::new(wide, high, 1.0))?;
    }
    test.sphere(DVec3::new(right + 0.5, 0.5, -40.0), arm)?;
    // At the bottom, a surface of grains a fifth of a pixel apart, and a sphere that it hides.
    let grains = |i: i32| f64::from(i) * 0.2;
    let low = -(height * 0.4).floor();
    for row in 0..20 {
        for column in 0..20 {
            let place = DVec3::new(grains(column) - 2.0, low + grains(row), -20.0);
            test.cube(place, DVec3::new(0.22, 0.22, 0.1))?;
        }
    }
    test.sphere(DVec3::new(0.0, low + 2.0, -40.0), 2.0)?;
    let mut run = Run::new(context, test.scene)?;
    // Aligned with the pixel grid, and off it by a third of a pixel.
    for off in [0.0, 1.0 / 3.0] {
        let eye = DVec3::new(off, off, 0.0);
        run.frame(&Camera::look_at(eye, eye - DVec3::Z, DVec3::Y, projection)?)?;
    }
    Ok(())
}
