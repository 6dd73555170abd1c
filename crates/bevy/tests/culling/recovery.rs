//! A device that is lost, and Bevy's recovery with another one.

use std::time::Duration;

use bevy::ecs::change_detection::{DetectChanges, Tick};
use bevy::render::error_handler::{RenderErrorHandler, RenderErrorPolicy};
use bevy::render::renderer::RenderDevice;

use crate::play::{Paint, Play, boxed};
use crate::{BEHIND, SIZE, headless};

#[test]
fn culling_goes_on_with_another_device() {
    let mut play = Play::new();
    play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    play.settle();
    assert!(play.culls(red));
    play.app.insert_resource(RenderErrorHandler(|_, _, _| {
        RenderErrorPolicy::Recover(headless::render_creation())
    }));
    let before = device_since(&play);
    let device = play.app.world().resource::<RenderDevice>();
    device.wgpu_device().destroy();
    for _ in 0..500 {
        play.app.update();
        if device_since(&play) != before {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    assert_ne!(device_since(&play), before);
    for _ in 0..20 {
        play.frame();
    }
    assert!(play.culls(red), "{:?}", play.report());
    assert!(play.seen(Paint::Grey) > 500);
}

/// When the app got its device. Devices of two instances of wgpu may be equal.
fn device_since(play: &Play) -> Tick {
    let device = play.app.world().get_resource_ref::<RenderDevice>();
    device.unwrap().last_changed()
}
