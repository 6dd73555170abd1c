//! Worlds by size and place: what holds for metres holds for millimetres, for millions of kilometres, and far from the origin.

use antumbra_scene::{Camera, Projection};
use glam::DVec3;

use crate::kit::failure::ViolationKind;
use crate::kit::play::{Bench, Play};
use crate::kit::props::Props;

/// A metre in each world, and where the world lies in its own metres.
const WORLDS: [(f64, f64); 3] = [(1e-4, 0.0), (1e8, 0.0), (1.0, 1e7)];

pub(super) fn worlds(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    for (metre, away) in WORLDS {
        let at = |x: f64, y: f64, z: f64| (DVec3::new(x, y, z) + DVec3::splat(away)) * metre;
        let mut props = Props::new()?;
        props.cube(at(0.0, 0.0, 0.0), DVec3::new(5.0, 4.0, 0.2) * metre)?;
        for column in -2..=2 {
            let x = f64::from(column);
            props.sphere(at(x, 0.1, -1.5), 0.7 * metre)?;
            props.sphere(at(x * 1.7, 0.3, 1.2), 0.4 * metre)?;
            props.cube(at(x * 2.0, 1.0, -4.0), DVec3::splat(metre))?;
        }
        let projection = Projection::Perspective {
            fov_y: 1.0,
            near: 0.1 * metre,
        };
        let mut play = Play::new(bench, props.scene)?;
        for step in 0..2 {
            let eye = at(0.4 * f64::from(step), 0.5, 6.0);
            play.frame(&Camera::look_at(
                eye,
                at(0.0, 0.0, 0.0),
                DVec3::Y,
                projection,
            )?)?;
        }
    }
    Ok(())
}
