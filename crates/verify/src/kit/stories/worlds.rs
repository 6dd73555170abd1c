//! The story about scale and origin: what holds in metres must hold in tenths of a millimetre, in units of 100,000 km, and far from the origin.

use antumbra_scene::{Camera, Projection};
use glam::DVec3;

use crate::kit::failure::ViolationKind;
use crate::kit::run::{CaseContext, Run};
use crate::kit::test_scene::TestScene;

/// The scale and the place of a world.
struct World {
    /// How many metres its unit is long.
    unit: f64,
    /// Each coordinate of its centre, in its units.
    offset: f64,
}

const WORLDS: [World; 3] = [
    World {
        unit: 1e-4,
        offset: 0.0,
    },
    World {
        unit: 1e8,
        offset: 0.0,
    },
    World {
        unit: 1.0,
        offset: 1e7,
    },
];

pub(super) fn worlds(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    for World { unit, offset } in WORLDS {
        let at = |x: f64, y: f64, z: f64| (DVec3::new(x, y, z) + DVec3::splat(offset)) * unit;
        let mut test = TestScene::new()?;
        test.cube(at(0.0, 0.0, 0.0), DVec3::new(5.0, 4.0, 0.2) * unit)?;
        for column in -2..=2 {
            let x = f64::from(column);
            test.sphere(at(x, 0.1, -1.5), 0.7 * unit)?;
            test.sphere(at(x * 1.7, 0.3, 1.2), 0.4 * unit)?;
            test.cube(at(x * 2.0, 1.0, -4.0), DVec3::splat(unit))?;
        }
        let projection = Projection::Perspective {
            fov_y: 1.0,
            near: 0.1 * unit,
        };
        let mut run = Run::new(context, test.scene)?;
        for step in 0..2 {
            let eye = at(0.4 * f64::from(step), 0.5, 6.0);
            run.frame(&Camera::look_at(
                eye,
                at(0.0, 0.0, 0.0),
                DVec3::Y,
                projection,
            )?)?;
        }
    }
    Ok(())
}
