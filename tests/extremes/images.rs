//! Images of one pixel, and of one row as wide as the device allows.

use antumbra::scene::Projection;
use antumbra_testing::{SceneBuilder, gpus, look_at, perspective_degrees};
use glam::DVec3;

use crate::play::Play;

#[test]
fn an_image_of_one_pixel() {
    // Three walls with a ball behind each, one a frame; then an empty view.
    let mut set = SceneBuilder::new();
    for x in [0.0, 8.0, 16.0] {
        set.cube(DVec3::new(x, 0.0, 0.0), DVec3::new(4.0, 4.0, 0.5));
        set.ball(DVec3::new(x, 0.0, -2.0), 3.0);
        set.ball(DVec3::new(x + 1.0, 1.5, 1.5), 0.25);
    }
    let frames = [0.0, 8.0, 16.0, 30.0].map(|x| {
        let eye = DVec3::new(x, 0.1, 6.0);
        look_at(eye, eye - DVec3::Z, perspective_degrees(60.0, 0.125))
    });
    let frames = frames.to_vec();
    let mut play = Play::new(set.scene, frames);
    play.size = [1, 1];
    play.agrees_with_the_twin(1.0, 1);
    play.is_right();
}

/// The widest image that software adapters draw.
const WIDE: u32 = 16384;

#[test]
fn an_image_of_16384_pixels_in_one_row() {
    for gpu in gpus() {
        let most = gpu.device.limits().max_texture_dimension_2d;
        // `refusals` tests what a device answers to an image wider than its limit.
        let width = most.min(WIDE);
        let mut set = SceneBuilder::new();
        for column in -20..=20 {
            let x = f64::from(column) * 0.2;
            set.cube(DVec3::new(x, 0.0, -6.0), DVec3::new(0.1, 1.0, 0.5));
            set.cube(DVec3::new(x * 1.5, 0.0, -9.0), DVec3::new(0.12, 1.0, 0.5));
            set.ball(DVec3::new(x, 0.0, -5.0), 0.01);
        }
        // A horizontal field of view of 90 degrees.
        let projection = Projection::Perspective {
            fov_y: 2.0 * (1.0 / f64::from(width)).atan(),
            near: 0.1,
        };
        let mut play = Play::new(
            set.scene,
            vec![look_at(DVec3::ZERO, DVec3::NEG_Z, projection)],
        );
        play.size = [width, 1];
        play.agrees_with_the_twin_on(&[gpu], 0.9, 60);
        for text in crate::play::strategies() {
            let outcome = play.by(gpu, &text, || crate::play::made(&text));
            assert!(outcome.is_ok(), "{}", outcome.unwrap_err());
        }
    }
}
