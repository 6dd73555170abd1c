//! Shapes: mirrored, rotated and sheared, scaled to zero and to 1e20, flat, and thinner than a pixel.

use antumbra::scene::{Geometry, Mesh};
use antumbra_testing::{SceneBuilder, look_at, perspective_degrees, placed};
use glam::{DAffine3, DMat3, DQuat, DVec3};

use crate::play::Play;

/// Two frames: from in front of the origin, then a little to the side.
fn before(set: SceneBuilder) -> Play {
    let from = |x: f64| {
        let eye = DVec3::new(x, 0.25, 6.0);
        look_at(
            eye,
            eye - DVec3::new(0.0, 0.04, 1.0),
            perspective_degrees(60.0, 0.125),
        )
    };
    Play::new(set.scene, vec![from(0.0), from(0.4)])
}

#[test]
fn mirrored_turned_and_sheared_shapes_show_their_fronts() {
    let mut set = SceneBuilder::still_life(1.0, DVec3::ZERO);
    for (number, scale) in [
        DVec3::new(-1.0, 1.0, 1.0),
        DVec3::new(1.0, -0.5, 1.0),
        DVec3::new(-1.0, -1.0, -1.0),
        DVec3::new(-0.5, -1.0, 1.0),
    ]
    .into_iter()
    .enumerate()
    {
        let x = number as f64 - 1.5;
        let turn = DQuat::from_rotation_y(x) * DQuat::from_rotation_x(0.5);
        for (y, z) in [(-0.75, 1.5), (0.5, -2.0)] {
            let place = DVec3::new(x, y, z);
            let at = DAffine3::from_scale_rotation_translation(scale * 0.6, turn, place);
            set.put(set.ball, at);
        }
        let shear = DMat3::from_cols(DVec3::X, DVec3::new(0.7, 0.6, 0.1), DVec3::Z);
        let sheared = DAffine3::from_mat3_translation(
            DMat3::from_diagonal(scale * 0.5) * shear,
            DVec3::new(x, 1.4, 2.0),
        );
        set.put(set.cube, sheared);
    }
    let play = before(set);
    play.agrees_with_the_twin(0.7, 14);
    play.is_right();
}

#[test]
fn scales_of_nothing_of_1e_minus_20_and_of_1e20() {
    let mut set = SceneBuilder::still_life(1.0, DVec3::ZERO);
    let mut place = |scale: DVec3, at: DVec3| {
        set.put(set.cube, placed(at, scale));
        set.put(set.ball, placed(at + DVec3::Y, scale));
    };
    // Visible and hidden.
    for z in [1.5, -2.0] {
        for scale in [0.0, 1e-20, -1e-20, 1e-300] {
            place(DVec3::splat(scale), DVec3::new(0.5, -0.5, z));
        }
        place(DVec3::new(0.0, 1e-20, 1.0), DVec3::new(-0.5, -0.5, z));
        place(DVec3::new(1.0, 0.0, 0.0), DVec3::new(-0.5, -0.6, z));
    }
    // As large as a wall at infinity.
    set.cube(DVec3::new(0.0, 0.3e20, -2e20), DVec3::splat(1e20));
    set.put(
        set.ball,
        placed(DVec3::new(-2e20, 0.0, -2e20), DVec3::new(-1e20, 1e20, 1e20)),
    );
    let play = before(set);
    play.agrees_with_the_twin(0.7, 10);
    play.is_right();
}

/// Adds a mesh, and an entity that shows it.
fn put_mesh(set: &mut SceneBuilder, name: &str, geometry: Geometry, place: DAffine3) {
    let mesh = set.scene.add_mesh(Mesh::new(name, geometry)).unwrap();
    set.put(mesh, place);
}

#[test]
fn flat_boxes_face_on_and_edge_on() {
    let mut set = SceneBuilder::still_life(1.0, DVec3::ZERO);
    for (number, size) in [
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::new(1.0, 0.0, 1.0),
        DVec3::new(0.0, 1.0, 1.0),
        DVec3::new(1.0, 1.0, 1e-12),
        DVec3::new(1.0, 1e-9, 1.0),
    ]
    .into_iter()
    .enumerate()
    {
        let x = number as f64 - 2.0;
        // Visible, and hidden behind the wall.
        set.cube(DVec3::new(x, 0.9, 1.5), size * 0.8);
        set.cube(DVec3::new(x, 0.0, -1.0), size * 0.8);
    }
    // Squares that tile a plane as wide as the wall, in the plane of its front and a millimetre in front of it.
    for x in -2..=2 {
        for off in [0.0, 1e-3] {
            let at = DVec3::new(f64::from(x), -1.5, 0.125 + off);
            set.put(set.square, placed(at, DVec3::new(1.0, 0.5, 1.0)));
        }
    }
    let play = before(set);
    play.agrees_with_the_twin(0.6, 12);
    play.is_right();
}

#[test]
fn blades_thinner_than_a_pixel_a_hundred_metres_long() {
    let mut set = SceneBuilder::still_life(1.0, DVec3::ZERO);
    let blade = || Geometry {
        positions: vec![[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [0.0, 0.004, -100.0]],
        indices: vec![0, 1, 2, 0, 2, 1],
        ..Geometry::default()
    };
    // Along the viewing direction, across it, through the wall and beside it.
    for number in 0..24 {
        let t = f64::from(number);
        let turn = DQuat::from_rotation_y(t * 0.26) * DQuat::from_rotation_x((t * 1.7).sin() * 0.3);
        let place = DVec3::new(
            (t * 0.9).sin() * 2.5,
            (t * 0.5).cos(),
            (t * 0.7).cos() * 3.0,
        );
        put_mesh(
            &mut set,
            "blade",
            blade(),
            DAffine3::from_rotation_translation(turn, place),
        );
    }
    let mut play = before(set);
    play.steps = 2;
    play.agrees_with_the_twin(0.6, 8);
    play.is_right();
}
