//! Sizes: from a hundredth of a pixel to half the sky, in one scene.

use antumbra_testing::{SceneBuilder, gpus, look_at, perspective_degrees};
use glam::DVec3;

use crate::play::Play;

#[test]
fn a_scene_of_sizes_a_billion_to_one() {
    let mut set = SceneBuilder::new();
    let mut place = |far: f64, x: f64, y: f64, size: f64| {
        let centre = DVec3::new(x, y, -1.0) * far;
        set.ball(centre, size);
        // One cube hidden behind the ball, one beside it.
        set.cube(centre * 1.5, DVec3::splat(size * 0.4));
        set.cube(centre * 1.25 + DVec3::X * size, DVec3::splat(size * 0.6));
    };
    // From a centimetre to ten thousand kilometres away, each large enough to be visible.
    for (number, power) in (-2..=7).enumerate() {
        let far = 10_f64.powi(power);
        let (column, row) = (number % 5, number / 5);
        place(
            far,
            column as f64 * 0.28 - 0.56,
            row as f64 * 0.4 - 0.1,
            far * 0.1,
        );
    }
    // The ground, a thousand kilometres wide.
    set.cube(DVec3::new(0.0, -3.0, -4e5), DVec3::new(1e6, 1.0, 1e6));
    // A grain on the ground, a hundredth of a pixel wide.
    set.ball(DVec3::new(0.5, -2.49, -10.0), 1e-3);
    let from = |x: f64| {
        let eye = DVec3::X * x;
        look_at(eye, eye - DVec3::Z, perspective_degrees(60.0, 1e-3))
    };
    let mut play = Play::new(set.scene, vec![from(0.0), from(1e-3)]);
    play.size = [96, 72];
    play.apart = 1e-3;
    // On OpenGL, depths beyond a few kilometres are equal: see `worlds.rs`.
    let [vulkan, _] = gpus();
    play.agrees_with_the_twin_on(&[vulkan], 0.7, 15);
    play.is_right();
}

#[test]
fn objects_of_a_hundredth_of_a_pixel_alone() {
    // None is wider than a tenth of a pixel. One that covers the centre of a pixel owns that pixel.
    let mut set = SceneBuilder::new();
    for number in 0..400 {
        let t = f64::from(number);
        let place = DVec3::new((t * 0.618).fract() - 0.5, (t * 0.414).fract() - 0.5, -1.0);
        let far = 4.0 + (t * 0.732).fract() * 40.0;
        let pixel = far * 2.0 * 30_f64.to_radians().tan() / 48.0;
        set.cube(place * far, DVec3::splat(pixel * 0.1));
    }
    // One exactly at the centre of a pixel.
    let half = 30_f64.to_radians().tan() / 48.0;
    let hit = set.cube(DVec3::new(half, half, -1.0) * 3.0, DVec3::splat(half * 0.6));
    set.ball(DVec3::new(0.0, -0.2, -60.0), 8.0);
    let camera = look_at(DVec3::ZERO, DVec3::NEG_Z, perspective_degrees(60.0, 0.1));
    let mut play = Play::new(set.scene, vec![camera; 2]);
    play.apart = 0.0;
    play.steps = 2;
    play.agrees_with_the_twin(0.7, 2);
    let [gpu, _] = gpus();
    let (scene, images) = play.seen(gpu);
    let id = crate::play::id_of(&scene, Some(hit));
    assert_eq!(images[0].ids.iter().filter(|one| **one == id).count(), 1);
    play.is_right();
}
