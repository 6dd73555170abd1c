//! What a camera leaves out, frame by frame, and that pictures are those without the plug-in.
#![allow(clippy::unwrap_used, clippy::panic)]

mod gizmos;
#[allow(dead_code, reason = "the examples use the rest")]
#[path = "../../examples/shared/headless.rs"]
mod headless;
mod motion;
mod occluders;
mod pictures;
mod play;
mod recovery;

use antumbra_bevy::{AntumbraCulling, Strategy};
use bevy::camera::visibility::{NoCpuCulling, NoFrustumCulling, RenderLayers, VisibilityRange};
use bevy::mesh::skinning::SkinnedMesh;
use bevy::prelude::*;
use play::{Paint, Play, boxed, from};

/// Behind the wall of [`Play::add_wall`], and beside it.
const BEHIND: [f32; 3] = [0.0, 0.0, -3.0];
const BESIDE: [f32; 3] = [5.5, 0.0, -3.0];
const SIZE: [f32; 3] = [1.0; 3];

#[test]
fn what_is_behind_a_wall_is_left_out_and_the_wall_is_not() {
    let mut play = Play::new();
    let wall = play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    play.frame();
    assert!(!play.culls(red), "nothing is known in the first frame");
    play.settle();
    assert!(play.culls(red) && !play.culls(wall));
    assert_eq!(play.report().drawn, 1);
    assert_eq!(play.report().fault, None);
    assert!(play.report().age.unwrap() <= 2, "{:?}", play.report().age);
}

#[test]
fn what_comes_into_view_is_drawn_in_its_first_frame() {
    let mut play = Play::new();
    play.add_wall();
    play.settle();
    let before = play.add(Paint::Red, boxed([0.0, 0.0, 3.0], SIZE));
    play.frame();
    assert!(play.seen(Paint::Red) > 50);
    play.app.world_mut().despawn(before);
    play.frame();
    assert_eq!(play.seen(Paint::Red), 0);
    // The box that comes takes the place of the one that went, which was hidden.
    let hidden = play.add(Paint::Red, boxed(BEHIND, SIZE));
    play.settle();
    assert!(play.culls(hidden));
    play.app.world_mut().despawn(hidden);
    let shown = play.add(Paint::Blue, boxed(BESIDE, SIZE));
    play.frame();
    assert!(play.seen(Paint::Blue) > 20);
    assert!(!play.culls(shown) && !play.culls(hidden));
}

#[test]
fn a_child_moves_with_its_parent() {
    let mut play = Play::new();
    play.add_wall();
    let red = play.add(Paint::Red, boxed([0.0; 3], SIZE));
    let parent = (
        Transform::from_translation(Vec3::from_array(BEHIND)),
        Visibility::default(),
    );
    let parent = play.app.world_mut().spawn(parent).id();
    play.set(red, ChildOf(parent));
    play.settle();
    assert!(play.culls(red));
    play.set(
        parent,
        Transform::from_translation(Vec3::from_array(BESIDE)),
    );
    play.frame();
    assert!(play.seen(Paint::Red) > 20);
}

#[test]
fn a_camera_that_jumps_sees_everything_in_its_first_frame() {
    // A shorter way than to the wall could be that of a fast flight: then its owner says that it is a cut.
    for (place, says_so) in [([0.0, 0.0, -20.0], false), ([10.0, 0.0, 12.0], true)] {
        let mut play = Play::new();
        play.add_wall();
        let red = play.add(Paint::Red, boxed([3.5, 0.0, -3.0], SIZE));
        play.settle();
        assert!(play.culls(red));
        let camera = play.camera;
        if says_so {
            let world = play.app.world_mut();
            world.get_mut::<AntumbraCulling>(camera).unwrap().cut();
        }
        play.set(camera, from(place));
        play.frame();
        assert!(!play.culls(red));
        assert_eq!(play.report().age, None);
        assert!(play.seen(Paint::Red) > 20);
        play.settle();
        assert!(play.report().age.is_some());
    }
}

#[test]
fn two_cameras_have_answers_of_their_own() {
    let mut play = Play::new();
    let wall = play.add_wall();
    // Not behind the blue one.
    let red = play.add(Paint::Red, boxed([2.0, 0.0, -3.0], SIZE));
    let blue = play.add(Paint::Blue, boxed([0.0, 0.0, 3.0], SIZE));
    let image = crate::headless::target(&mut play.app, [200, 100]);
    let other = play.add_camera(
        image,
        from([0.0, 0.0, -20.0]),
        (AntumbraCulling::default(), Msaa::Off),
    );
    play.settle();
    assert_eq!(play.report().culled, [red]);
    assert_eq!(play.report_of(other).culled, [blue]);
    // One that stops culling draws everything, and the other does not notice.
    play.set(
        other,
        AntumbraCulling {
            strategy: Strategy::Off,
            ..default()
        },
    );
    play.frame();
    assert_eq!(play.report().culled, [red]);
    assert_eq!(
        (play.report_of(other).drawn, play.report_of(other).age),
        (3, None)
    );
    play.app.world_mut().despawn(wall);
    play.settle();
    assert_eq!(play.report().culled, [] as [Entity; 0]);
}

#[test]
fn a_target_of_another_size_keeps_what_is_known() {
    let mut play = Play::new();
    play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    play.settle();
    play.size = [333, 77];
    play.image = crate::headless::target(&mut play.app, play.size);
    let target = bevy::camera::RenderTarget::from(play.image.clone());
    play.set(play.camera, target);
    for _ in 0..3 {
        play.frame();
        assert!(play.culls(red));
    }
    assert!(play.seen(Paint::Grey) > 500);
    assert!(play.report().age.unwrap() <= 2);
}

#[test]
fn what_bevy_does_not_cull_by_a_box_is_never_left_out() {
    let mut play = Play::new();
    play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    play.settle();
    assert!(play.culls(red));
    play.set(red, NoFrustumCulling);
    play.frame();
    assert!(!play.culls(red));
    play.app
        .world_mut()
        .entity_mut(red)
        .remove::<NoFrustumCulling>();
    play.settle();
    assert!(play.culls(red));
    play.set(red, NoCpuCulling);
    play.frame();
    assert!(!play.culls(red));
    assert_eq!(play.report().drawn, 1, "it is in no list");
    // A skin whose box is not updated.
    let blue = play.add(Paint::Blue, boxed(BEHIND, SIZE));
    play.settle();
    assert!(play.culls(blue));
    play.set(blue, SkinnedMesh::default());
    play.frame();
    assert!(!play.culls(blue));
}

#[test]
fn layers_and_ranges_are_bevys() {
    let mut play = Play::new();
    let wall = play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    let blue = play.add(Paint::Blue, boxed(BEHIND, SIZE));
    play.set(blue, VisibilityRange::abrupt(0.0, 10.0));
    play.settle();
    assert_eq!(play.report().culled, [red]);
    // A wall that this camera does not see hides nothing from it.
    play.set(wall, RenderLayers::layer(1));
    play.settle();
    assert!(!play.culls(red));
    assert!(play.seen(Paint::Red) > 20 && play.seen(Paint::Grey) == 0);
    play.set(play.camera, RenderLayers::from_layers(&[1]));
    play.settle();
    assert!(play.seen(Paint::Red) == 0 && play.seen(Paint::Grey) > 500);
    assert_eq!(play.report().drawn, 1);
}

#[test]
fn a_frozen_camera_keeps_what_it_has_left_out_wherever_it_goes() {
    let mut play = Play::new();
    play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    play.settle();
    let camera = play.camera;
    let frozen = AntumbraCulling {
        frozen: true,
        ..default()
    };
    play.set(camera, frozen);
    for _ in 0..3 {
        play.set(camera, from([20.0, 0.0, -20.0]));
        play.frame();
        assert!(play.culls(red));
    }
    play.set(camera, AntumbraCulling::default());
    play.settle();
    assert!(!play.culls(red) && play.seen(Paint::Red) > 20);
}

#[test]
fn a_camera_that_is_no_longer_frozen_forgets_what_it_knew() {
    let mut play = Play::new();
    let wall = play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    play.settle();
    let frozen = AntumbraCulling {
        frozen: true,
        ..default()
    };
    play.set(play.camera, frozen);
    play.frame();
    play.app.world_mut().despawn(wall);
    play.frame();
    assert!(play.culls(red));
    play.set(play.camera, AntumbraCulling::default());
    play.frame();
    assert!(!play.culls(red) && play.seen(Paint::Red) > 20);
}

#[test]
fn a_camera_that_draws_into_a_part_of_its_target_says_why_it_does_not_cull() {
    let mut play = Play::new();
    play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    let part = bevy::camera::Viewport {
        physical_size: UVec2::new(80, 120),
        ..default()
    };
    let camera = play.camera;
    play.app
        .world_mut()
        .get_mut::<Camera>(camera)
        .unwrap()
        .viewport = Some(part);
    play.settle();
    assert!(!play.culls(red));
    let fault = play.report().fault.clone().unwrap();
    assert!(fault.contains("part of its target"), "{fault}");
    // A camera that is switched off has nothing to explain.
    let off = AntumbraCulling {
        strategy: Strategy::Off,
        ..default()
    };
    play.set(play.camera, off);
    play.frame();
    assert_eq!(play.report().fault, None);
}

#[test]
fn the_first_answers_are_about_where_the_camera_is() {
    let mut play = Play::with([160, 120], Msaa::Off);
    // Nearer to the camera than the origin is.
    play.add(Paint::Grey, boxed([0.0, 0.0, 10.0], [8.0, 8.0, 0.5]));
    let red = play.add(Paint::Red, boxed([0.0, 0.0, 8.0], SIZE));
    // Everything is on the device before anything is asked.
    play.settle();
    play.set(play.camera, AntumbraCulling::default());
    for _ in 0..4 {
        play.frame();
        if play.report().age.is_some() {
            break;
        }
    }
    assert!(play.culls(red), "{:?}", play.report());
    assert_eq!(play.report().shift, 0.0, "a camera at rest");
    for step in 1..5 {
        play.set(play.camera, from([0.05 * step as f32, 0.0, 20.0]));
        play.frame();
    }
    assert_eq!(play.report().shift, antumbra_bevy::Budget::FIRST_SHIFT);
    let off = AntumbraCulling {
        strategy: Strategy::Off,
        ..default()
    };
    play.set(play.camera, off);
    play.frame();
    assert_eq!(play.report().shift, 0.0);
}
