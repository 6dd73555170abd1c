//! What moves, turns, comes to rest and bends.

use antumbra_bevy::{AntumbraCulling, Audit, Budget};
use bevy::mesh::morph::MorphAttributes;
use bevy::prelude::*;

use crate::play::{Paint, Play, boxed, from};
use crate::{BEHIND, BESIDE, SIZE};

#[test]
fn what_moves_from_behind_a_wall_appears_at_once_and_is_left_out_again_behind_it() {
    let mut play = Play::new();
    play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    play.settle();
    assert!(play.culls(red));
    play.set(red, boxed(BESIDE, SIZE));
    play.frame();
    assert!(play.seen(Paint::Red) > 20);
    play.set(red, boxed(BEHIND, SIZE));
    play.settle();
    assert!(play.culls(red));
    // Its box grows beyond the wall.
    play.set(red, boxed(BEHIND, [14.0, 1.0, 1.0]));
    play.frame();
    assert!(play.seen(Paint::Red) > 20);
}

#[test]
fn what_keeps_moving_behind_a_wall_is_left_out_most_of_the_time_and_never_missing() {
    let mut play = Play::new();
    play.add_wall();
    let red = play.add(Paint::Red, boxed([-2.0, 0.0, -3.0], SIZE));
    play.settle();
    let mut left_out = 0;
    for step in 0..60 {
        let x = -2.0 + 0.15 * step as f32;
        play.set(red, boxed([x, 0.0, -3.0], SIZE));
        play.frame();
        left_out += u32::from(play.culls(red));
        // The wall hides up to 4 m; at a depth of 23 m that is 4.6 m.
        if x > 5.2 {
            assert!(play.seen(Paint::Red) > 20, "{x}");
        }
    }
    assert!(left_out > 12, "{left_out}");
}

/// A bar through a point, turned about the line of sight by half a right angle.
fn bar(centre: [f32; 3], size: [f32; 3], sign: f32) -> Transform {
    boxed(centre, size).with_rotation(Quat::from_rotation_z(sign * std::f32::consts::FRAC_PI_4))
}

#[test]
fn what_turns_within_its_box_in_the_world_is_drawn_at_once() {
    let mut play = Play::new();
    play.add(Paint::Grey, bar([0.0; 3], [12.0, 3.0, 0.5], 1.0));
    let size = [7.0, 0.5, 0.5];
    let red = play.add(Paint::Red, bar(BEHIND, size, 1.0));
    play.settle();
    assert!(play.culls(red));
    // The mirror image has the same box along the world's axes.
    play.set(red, bar(BEHIND, size, -1.0));
    play.frame();
    assert!(!play.culls(red) && play.seen(Paint::Red) > 20);
}

#[test]
fn what_has_come_to_rest_is_tested_as_itself_again() {
    let mut play = Play::new();
    play.add_wall();
    let red = play.add(Paint::Red, boxed([-1.0, 0.0, -3.0], SIZE));
    play.settle();
    // In eight frames more it would be beside the wall.
    for step in 0..5 {
        play.set(red, boxed([-1.0 + 0.7 * step as f32, 0.0, -3.0], SIZE));
        play.frame();
    }
    play.settle();
    assert!(!play.culls(red), "it may go on");
    for _ in 0..20 {
        play.frame();
    }
    assert!(play.culls(red));
}

#[test]
fn what_morph_targets_bend_is_not_taken_for_a_ball() {
    let mut left_out = Vec::new();
    for is_morphed in [false, true] {
        let mut play = Play::new();
        // The corners of the ball's box look out beside the disc.
        let disc = Mesh::from(Cylinder::new(4.0, 0.5));
        let mut ball = Mesh::from(Sphere::new(3.8));
        if is_morphed {
            let bends = vec![MorphAttributes::default(); ball.count_vertices()];
            ball.set_morph_targets(bends);
        }
        let facing = Transform::from_rotation(Quat::from_rotation_x(std::f32::consts::FRAC_PI_2));
        play.add_mesh(Paint::Grey, disc, facing);
        let ball = play.add_mesh(Paint::Red, ball, Transform::from_xyz(0.0, 0.0, -8.0));
        play.settle();
        left_out.push(play.culls(ball));
    }
    assert_eq!(left_out, [true, false]);
}

#[test]
fn a_budget_that_could_not_be_kept_is_tried_again() {
    let settings = AntumbraCulling {
        budget: Budget::WrongPixels(0.02),
        audit: Audit::Every(1),
        ..default()
    };
    let mut play = Play::with([640, 480], (settings, Msaa::Off));
    let wall = boxed([0.0; 3], [21.0, 15.0, 0.5]);
    let grey = play.add(Paint::Grey, wall);
    let red = play.add(Paint::Red, boxed([0.0, 0.0, -1.0], SIZE));
    let frame = |play: &mut Play, number: usize, place: Transform| {
        play.set(grey, place);
        let camera = play.camera;
        play.set(camera, from([0.01 * number as f32, 0.0, 20.0]));
        play.frame();
    };
    // A wall that jumps to and fro uncovers it again and again, whatever the pixels are: in the end it is drawn behind a wall that rests, too.
    let away = boxed([100.0, 0.0, 0.0], [21.0, 15.0, 0.5]);
    let mut numbers = 0..;
    let mut next = |play: &mut Play, place: Transform| {
        frame(play, numbers.next().unwrap(), place);
    };
    let gave_up = (0..30).any(|_| {
        for place in [wall, away, wall, away, wall, wall, wall, wall] {
            next(&mut play, place);
        }
        play.report().age.is_some() && !play.culls(red)
    });
    assert!(gave_up, "{:?}", play.report());
    let again = (0..60).find(|_| {
        next(&mut play, wall);
        play.culls(red)
    });
    assert!(again.is_some());
}
