//! Bevy's stress test of that name: cubes on a ball around the camera, in the order of a Fibonacci spiral. They hide little of each other, so that it shows what culling costs where it does not pay.
//!
//!     scripts/bevy.sh run --example many_cubes -- --measure --frames 20

#[path = "shared/arguments.rs"]
mod arguments;
#[path = "shared/headless.rs"]
mod headless;
#[path = "shared/measure.rs"]
mod measure;
#[path = "shared/run.rs"]
mod run;
#[path = "shared/stages.rs"]
mod stages;
#[path = "shared/view.rs"]
mod view;

use std::f32::consts::TAU;

use bevy::prelude::*;
use view::{View, Way};

fn main() {
    let count = arguments::Arguments::of_process()
        .scene_size
        .unwrap_or(40_000);
    let view = View {
        way: Way::Turn { radians: 0.01 },
        degrees: 45.0,
    };
    run::run(view, &|app| spawn(app, count));
}

/// Cubes of 1 m on a ball, as far from each other as if 160,000 were on one of 200 m.
fn spawn(app: &mut App, count: u32) {
    let radius = 200.0 * (count as f32 / 160_000.0).sqrt();
    let world = app.world_mut();
    let cube = world
        .resource_mut::<Assets<Mesh>>()
        .add(Cuboid::from_length(1.0));
    let paint = world
        .resource_mut::<Assets<StandardMaterial>>()
        .add(StandardMaterial::default());
    let golden = 0.5 * (1.0 + 5.0_f32.sqrt());
    for number in 0..count {
        let turn = TAU * (number as f32 / golden).fract();
        let height = 1.0 - 2.0 * (number as f32 + 0.5) / count as f32;
        let across = (1.0 - height * height).sqrt();
        let (sin, cos) = turn.sin_cos();
        let place = Vec3::new(across * cos, height, across * sin) * radius;
        let place = Transform::from_translation(place).looking_at(Vec3::ZERO, Vec3::Y);
        world.spawn((Mesh3d(cube.clone()), MeshMaterial3d(paint.clone()), place));
    }
    world.spawn((
        DirectionalLight::default(),
        Transform::IDENTITY.looking_at(Vec3::new(0.0, -1.0, -1.0), Vec3::Y),
    ));
}
