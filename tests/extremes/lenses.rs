//! Projections: near planes at a tenth of a millimetre and at a kilometre, telescopes, fish eyes, and orthographic views.

use antumbra::scene::Projection;
use antumbra_testing::{SceneBuilder, gpus, look_at, perspective_degrees};
use glam::DVec3;

use crate::play::Play;

/// The still life from six units away, with a ball and a cube across the near plane. A unit is `metre` metres, the near plane is at `near`
/// metres.
fn before(near: f64, metre: f64) -> Play {
    let mut set = SceneBuilder::still_life(metre, DVec3::ZERO);
    let eye = DVec3::new(0.25, 0.5, 6.0) * metre;
    let target = DVec3::new(0.25, 0.25, 0.0) * metre;
    let camera = look_at(eye, target, perspective_degrees(60.0, near));
    let cut = eye + (camera.forward() * 1.5 + camera.right() * 1.2) * near;
    set.ball(cut, 1.5 * near);
    set.cube(
        cut - camera.right() * (2.4 * near),
        DVec3::splat(1.2 * near),
    );
    Play {
        apart: 0.05 * near,
        ..Play::new(set.scene, vec![camera; 2])
    }
}

#[test]
fn a_near_plane_of_a_tenth_of_a_millimetre() {
    let play = before(1e-4, 1.0);
    play.agrees_with_the_twin(0.7, 7);
    play.is_right();
}

#[test]
fn a_near_plane_of_a_kilometre() {
    let play = before(1e3, 1e3);
    play.agrees_with_the_twin(0.7, 7);
    play.is_right();
}

/// The still life from the distance at which it fills a view of `degrees`.
fn filling(degrees: f64) -> Play {
    let away = 2.5 / (degrees.to_radians() * 0.5).tan();
    let set = SceneBuilder::still_life(1.0, DVec3::ZERO);
    let from = |x: f64| {
        let eye = DVec3::new(x, 0.1, 1.0) * away;
        let target = DVec3::new(0.0, 0.25, 0.0);
        look_at(eye, target, perspective_degrees(degrees, away * 0.1))
    };
    Play {
        apart: away * 0.01,
        ..Play::new(set.scene, vec![from(0.0), from(0.1), from(0.2)])
    }
}

#[test]
fn a_field_of_view_of_a_hundredth_of_a_degree() {
    let play = filling(0.01);
    play.agrees_with_the_twin(0.7, 8);
    play.is_right();
}

#[test]
fn a_field_of_view_of_179_degrees() {
    // The camera is inside: a wall on each side, with an object in front of it and two behind it.
    let mut set = SceneBuilder::new();
    for side in [-1.0, 1.0] {
        for axis in DVec3::AXES {
            let aside = if axis == DVec3::Y { DVec3::X } else { DVec3::Y };
            let thin = DVec3::splat(3.0) - axis * 2.9;
            set.cube(axis * side * 4.0, thin);
            set.ball(axis * side * 2.0 + aside * 0.5, 0.5);
            set.ball(axis * side * 7.0 + aside * 0.25, 1.0);
            set.cube(axis * side * 6.0 + aside * 3.0, DVec3::splat(1.0));
        }
    }
    let towards = |x: f64| {
        look_at(
            DVec3::ZERO,
            DVec3::new(x, 0.1, -1.0),
            perspective_degrees(179.0, 0.01),
        )
    };
    let mut play = Play::new(set.scene, vec![towards(0.0), towards(0.3)]);
    play.size = [96, 96];
    play.agrees_with_the_twin(0.7, 5);
    play.is_right();
}

/// The still life in an orthographic view six units high. A unit is `metre` metres; `near` and `far` are in units.
fn parallel(set: SceneBuilder, metre: f64, near: f64, far: f64) -> Play {
    let set = set.with_still_life(metre, DVec3::ZERO);
    let projection = Projection::Orthographic {
        height: 6.0 * metre,
        near: near * metre,
        far: far * metre,
    };
    let from = |x: f64| {
        let eye = DVec3::new(x, 0.25, 6.0) * metre;
        look_at(eye, eye + DVec3::new(-0.25 * x, 0.0, -1.0), projection)
    };
    let mut play = Play::new(set.scene, vec![from(0.0), from(0.5)]);
    play.apart = 0.125 * metre;
    play
}

#[test]
fn parallel_views_of_a_centimetre_and_of_a_thousand_kilometres() {
    for (metre, near, far, owners) in [
        (1e-2 / 6.0, 0.0, 100.0, 7),
        (1e6 / 6.0, 0.0, 100.0, 7),
        (1.0, -20.0, 50.0, 7),
        // The near and the far plane clip the wall, and its back faces are not drawn.
        (1.0, 6.0, 50.0, 3),
        (1.0, 1.0, 6.0, 6),
    ] {
        let play = parallel(SceneBuilder::new(), metre, near, far);
        play.agrees_with_the_twin(0.7, owners);
        play.is_right();
    }
}

/// Orthographic depth resolves a 2^24th of its range, which is here larger than the scene. All entities tie, and all are drawn.
#[test]
fn a_parallel_view_so_deep_that_all_depths_are_equal() {
    let play = parallel(SceneBuilder::plain(), 1e-3, 0.0, 1e12);
    for gpu in gpus() {
        for image in play.seen(gpu).1 {
            assert!(image.owners().len() > 5);
        }
    }
    play.is_right();
}
