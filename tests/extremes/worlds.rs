//! Worlds by size and place.

use antumbra_testing::{SceneBuilder, gpus, look_at, perspective_degrees};
use glam::DVec3;

use crate::play::Play;

/// The still life from the front, then from a little to the side, in a world whose unit is `metre` metres.
fn world(metre: f64, origin: DVec3) -> Play {
    let set = SceneBuilder::still_life(metre, origin);
    let at = |x: f64, y: f64, z: f64| origin + DVec3::new(x, y, z) * metre;
    let from = |x: f64| {
        look_at(
            at(x, 0.5, 6.0),
            at(x, 0.25, 0.0),
            perspective_degrees(60.0, 0.125 * metre),
        )
    };
    Play {
        apart: 0.0625 * metre,
        ..Play::new(set.scene, vec![from(0.0), from(0.5)])
    }
}

/// A unit that is a power of two, so that scaling is exact.
fn metre(power: i32) -> f64 {
    2.0_f64.powi(power)
}

#[test]
fn a_world_of_a_millimetre_is_drawn_as_the_same_world_in_metres() {
    let small = world(metre(-13), DVec3::ZERO);
    small.agrees_with_the_twin(0.75, 8);
    assert_eq!(small.is_right(), world(1.0, DVec3::ZERO).is_right());
}

#[test]
fn a_world_of_a_million_kilometres_is_drawn_as_the_same_world_in_metres() {
    let large = world(metre(27), DVec3::ZERO);
    large.agrees_with_the_twin(0.75, 8);
    assert_eq!(large.is_right(), world(1.0, DVec3::ZERO).is_right());
}

#[test]
fn ten_thousand_kilometres_away_the_verdicts_are_the_same() {
    let away = world(1.0, DVec3::new(1e7, -1e7, 1e7));
    away.agrees_with_the_twin(0.75, 8);
    assert_eq!(away.is_right(), world(1.0, DVec3::ZERO).is_right());
}

/// Three walls a hundred thousand kilometres apart, each half hidden by the one in front of it, behind a cube close to the camera.
fn walls_far_away(near: f64) -> Play {
    let mut set = SceneBuilder::new();
    set.cube(
        DVec3::new(-0.5, -0.25, -4.0) * near.max(1.0),
        DVec3::splat(0.5 * near.max(1.0)),
    );
    for (number, far) in [1.0e9, 1.1e9, 1.2e9].into_iter().enumerate() {
        let x = (number as f64 - 1.0) * 0.25 * far;
        let size = DVec3::new(0.5 * far, 0.6 * far, 1e6);
        set.cube(DVec3::new(x, 0.0, -far), size);
    }
    // Hidden by the nearest wall.
    set.ball(DVec3::new(-0.3e9, 0.0, -1.3e9), 1e8);
    let from = |x: f64| {
        let eye = DVec3::X * x;
        look_at(eye, eye - DVec3::Z, perspective_degrees(60.0, near))
    };
    Play::new(set.scene, vec![from(0.0), from(0.125)])
}

#[test]
fn what_stands_a_million_kilometres_away_is_still_in_order() {
    let [vulkan, gl] = gpus();
    let play = walls_far_away(1e-4);
    play.agrees_with_the_twin_on(&[vulkan], 0.9, 5);
    play.is_right();
    // On OpenGL depth is mapped from -1..1, which leaves a resolution of a 2^24th of the near plane's depth: beyond that, depths are equal.
    walls_far_away(1e3).agrees_with_the_twin_on(&[gl], 0.9, 5);
}
