//! The story about unusual projections: telescopes, fish eyes, near planes at a tenth of a millimetre and at a kilometre, orthographic views.

use antumbra_scene::{Camera, Projection};
use glam::DVec3;

use crate::kit::failure::ViolationKind;
use crate::kit::run::{CaseContext, Run};
use crate::kit::test_scene::TestScene;

pub(super) fn lenses(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let perspective = |degrees: f64, near: f64| Projection::Perspective {
        fov_y: degrees.to_radians(),
        near,
    };
    // Each with the distance in metres of the eye from the scene, which is about eight metres wide.
    let views = [
        (perspective(0.01, 1.0), 3e4),
        (perspective(179.0, 0.01), 3.0),
        (perspective(60.0, 1e-4), 5.0),
        (perspective(0.4, 1e3), 1.1e3),
        (
            Projection::Orthographic {
                height: 6.0,
                near: -2.0,
                far: 50.0,
            },
            6.0,
        ),
        (
            Projection::Orthographic {
                height: 1e-2,
                near: 0.0,
                far: 1e6,
            },
            4.0,
        ),
    ];
    let mut test = TestScene::new()?;
    test.cube(DVec3::ZERO, DVec3::new(2.0, 1.5, 0.2))?;
    for column in -2..=2 {
        let x = f64::from(column) * 0.8;
        test.sphere(DVec3::new(x, 0.0, -1.0), 0.7)?;
        test.cube(DVec3::new(x * 2.0, 0.6, -3.0), DVec3::splat(0.5))?;
        test.sphere(DVec3::new(x, -0.5, 0.9), 0.2)?;
    }
    let mut run = Run::new(context, test.scene)?;
    for (projection, distance) in views {
        let eye = DVec3::new(0.013, 0.021, 1.0) * distance;
        let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, projection)?;
        run.cut(&camera)?;
        run.frame(&camera)?;
    }
    Ok(())
}
