//! Between covered and seen: a wall just as large as what it hides, a hole of one pixel, and dust too fine for any pixel alone.

use antumbra_scene::{Camera, Projection};
use glam::DVec3;

use crate::kit::failure::ViolationKind;
use crate::kit::play::{Bench, Play};
use crate::kit::props::Props;

pub(super) fn gaps(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let [width, height] = bench.kit.size.map(f64::from);
    // A metre a pixel, the origin between pixels.
    let projection = Projection::Orthographic {
        height,
        near: 0.0,
        far: 100.0,
    };
    let mut props = Props::new()?;
    // Left, a wall that ends where what it hides ends.
    let covered = (height / 3.0).floor();
    let left = -(width / 4.0).floor();
    props.cube(
        DVec3::new(left, 0.0, -20.0),
        DVec3::new(covered, covered, 1.0),
    )?;
    props.cube(
        DVec3::new(left, 0.0, -40.0),
        DVec3::new(covered, covered, 1.0),
    )?;
    // Right, four walls around one pixel, and something behind it.
    let right = (width / 4.0).floor();
    let arm = covered * 0.5;
    for (x, y, wide, high) in [
        (-arm * 0.5, 0.5, arm, 2.0 * arm),
        (1.0 + arm * 0.5, 0.5, arm, 2.0 * arm),
        (0.5, -arm * 0.5, 1.0, arm),
        (0.5, 1.0 + arm * 0.5, 1.0, arm),
    ] {
        props.cube(DVec3::new(right + x, y, -20.0), DVec3::new(wide, high, 1.0))?;
    }
    props.sphere(DVec3::new(right + 0.5, 0.5, -40.0), arm)?;
    // Below, a surface of grains a fifth of a pixel wide, and something that it hides.
    let grains = |i: i32| f64::from(i) * 0.2;
    let low = -(height * 0.4).floor();
    for row in 0..20 {
        for column in 0..20 {
            let place = DVec3::new(grains(column) - 2.0, low + grains(row), -20.0);
            props.cube(place, DVec3::new(0.22, 0.22, 0.1))?;
        }
    }
    props.sphere(DVec3::new(0.0, low + 2.0, -40.0), 2.0)?;
    let mut play = Play::new(bench, props.scene)?;
    // On the grid of pixels, and a third of a pixel off.
    for off in [0.0, 1.0 / 3.0] {
        let eye = DVec3::new(off, off, 0.0);
        play.frame(&Camera::look_at(eye, eye - DVec3::Z, DVec3::Y, projection)?)?;
    }
    Ok(())
}
