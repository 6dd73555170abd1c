//! Cameras as nobody builds them: telescopes, fish eyes, near planes a hair or a kilometre away, and views without perspective.

use antumbra_scene::{Camera, Projection};
use glam::DVec3;

use crate::kit::failure::ViolationKind;
use crate::kit::play::{Bench, Play};
use crate::kit::props::Props;

pub(super) fn lenses(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let perspective = |degrees: f64, near: f64| Projection::Perspective {
        fov_y: degrees.to_radians(),
        near,
    };
    // How far the eye stands from a scene of about eight metres.
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
    let mut props = Props::new()?;
    props.cube(DVec3::ZERO, DVec3::new(2.0, 1.5, 0.2))?;
    for column in -2..=2 {
        let x = f64::from(column) * 0.8;
        props.sphere(DVec3::new(x, 0.0, -1.0), 0.7)?;
        props.cube(DVec3::new(x * 2.0, 0.6, -3.0), DVec3::splat(0.5))?;
        props.sphere(DVec3::new(x, -0.5, 0.9), 0.2)?;
    }
    let mut play = Play::new(bench, props.scene)?;
    for (projection, away) in views {
        let eye = DVec3::new(0.013, 0.021, 1.0) * away;
        let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, projection)?;
        play.cut(&camera)?;
        play.frame(&camera)?;
    }
    Ok(())
}
