//! The boxes of what is culled can be seen through what hides it.

use antumbra_bevy::{AntumbraCulling, CullingGizmos};
use bevy::prelude::*;

use crate::play::{Paint, Play, boxed, differences, from};
use crate::{BEHIND, SIZE};

fn show(play: &mut Play, enabled: bool) {
    let mut store = play.app.world_mut().resource_mut::<GizmoConfigStore>();
    store.config_mut::<CullingGizmos>().0.enabled = enabled;
}

#[test]
fn boxes_of_what_is_culled_are_drawn_over_what_hides_it_where_asked() {
    let mut play = Play::new();
    play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    play.settle();
    assert!(play.culls(red));
    let plain = play.pixels();
    show(&mut play, true);
    play.settle();
    assert!(play.culls(red));
    let shown = play.pixels();
    // The box is about six pixels wide: its edges are at least its outline.
    assert!(differences(&plain, &shown) > 12);
    show(&mut play, false);
    play.settle();
    assert_eq!(differences(&plain, &play.pixels()), 0);
}

#[test]
fn what_a_frozen_camera_saw_is_drawn_for_another_one() {
    let mut play = Play::new();
    play.add_wall();
    play.settle();
    let camera = play.camera;
    let frozen = AntumbraCulling {
        frozen: true,
        ..default()
    };
    play.set(camera, frozen);
    play.settle();
    // From the side.
    play.set(camera, from([20.0, 6.0, 20.0]));
    play.settle();
    let plain = play.pixels();
    show(&mut play, true);
    play.settle();
    assert!(differences(&plain, &play.pixels()) > 40);
}
