//! Rooms in a row of rows, each with a door to the next and full of things, and a walk through their doors.
//!
//!     scripts/bevy.sh run --example rooms -- --measure --frames 20

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

use bevy::prelude::*;
use view::{View, Way};

/// Metres from the middle of a room to that of the next.
const ROOM: f32 = 6.0;
/// Width and height of a door, and height of a room.
const DOOR: [f32; 2] = [1.2, 2.2];
const HEIGHT: f32 = 3.0;
/// Things in a room.
const THINGS: usize = 40;

fn main() {
    let rooms = arguments::Arguments::of_process().scene_size.unwrap_or(12);
    let half = ROOM * rooms as f32 * 0.5;
    // Through the doors of a row in the middle.
    let x = ROOM * ((rooms / 2) as f32 + 0.5) - half;
    let view = View {
        way: Way::Walk {
            from: Vec3::new(x, 1.7, half - 1.0),
            to: Vec3::new(x, 1.7, 1.0 - half),
            step: 0.08,
            sideways: 1.2,
        },
        degrees: 60.0,
    };
    run::run(view, &|app| spawn(app, rooms, half));
}

/// Rooms side by side around the origin.
fn spawn(app: &mut App, rooms: u32, half: f32) {
    let world = app.world_mut();
    let mut meshes = world.resource_mut::<Assets<Mesh>>();
    let cube = meshes.add(Cuboid::from_length(1.0));
    let shapes = [
        cube.clone(),
        meshes.add(
            Sphere::new(0.5)
                .mesh()
                .ico(4)
                .unwrap_or_else(|_| Sphere::new(0.5).into()),
        ),
        meshes.add(Torus::new(0.25, 0.5)),
        meshes.add(Cylinder::new(0.5, 1.0)),
    ];
    let mut materials = world.resource_mut::<Assets<StandardMaterial>>();
    // No light comes into the rooms but what is everywhere: each way that a wall faces has its own tone.
    let [floor, ceiling, along_x, along_z] = [0.35, 0.9, 0.75, 0.6]
        .map(|tone| materials.add(Color::srgb(tone, tone * 0.97, tone * 0.92)));
    let paints: Vec<_> = (0..6)
        .map(|number| materials.add(Color::hsl(60.0 * number as f32, 0.6, 0.5)))
        .collect();
    let mut wall = |middle: Vec3, size: Vec3, paint: &Handle<StandardMaterial>| {
        let place = Transform::from_translation(middle).with_scale(size);
        world.spawn((Mesh3d(cube.clone()), MeshMaterial3d(paint.clone()), place));
    };
    let size = 2.0 * half;
    let slab = Vec3::new(size, 0.1, size);
    wall(Vec3::new(0.0, -0.05, 0.0), slab, &floor);
    wall(Vec3::new(0.0, HEIGHT + 0.05, 0.0), slab, &ceiling);
    for line in 0..=rooms {
        let at = line as f32 * ROOM - half;
        for room in 0..rooms {
            let middle = (room as f32 + 0.5) * ROOM - half;
            let is_outer = line == 0 || line == rooms;
            // Along X and along Z.
            let quarter = Quat::from_rotation_y(std::f32::consts::FRAC_PI_2);
            for (turn, paint) in [(Quat::IDENTITY, &along_x), (quarter, &along_z)] {
                for (side, width, low) in parts(is_outer) {
                    let height = HEIGHT - low;
                    let place = turn * Vec3::new(middle + side, low + height * 0.5, at);
                    let size = turn * Vec3::new(width, height, 0.15);
                    wall(place, size.abs(), paint);
                }
            }
        }
    }
    // Things on the floors, some on top of each other.
    let mut number = 0u32;
    for room in 0..rooms * rooms {
        let corner = Vec3::new((room % rooms) as f32, 0.0, (room / rooms) as f32) * ROOM
            - Vec3::new(half, 0.0, half);
        for _ in 0..THINGS {
            number = number.wrapping_add(1);
            let place = corner
                + Vec3::new(
                    0.5 + 5.0 * dice(number, 1),
                    0.2 + 1.2 * dice(number, 2),
                    0.5 + 5.0 * dice(number, 3),
                );
            let place = Transform::from_translation(place)
                .with_scale(Vec3::splat(0.15 + 0.35 * dice(number, 4)))
                .with_rotation(Quat::from_rotation_y(6.0 * dice(number, 5)));
            let shape = shapes[number as usize % shapes.len()].clone();
            let paint = paints[number as usize % paints.len()].clone();
            world.spawn((Mesh3d(shape), MeshMaterial3d(paint), place));
        }
    }
    let sun = DirectionalLight {
        illuminance: 3_000.0,
        ..default()
    };
    world.spawn((
        sun,
        Transform::from_xyz(3.0, 8.0, 2.0).looking_at(Vec3::ZERO, Vec3::Y),
    ));
}

/// A wall as boxes: offset along it, width, and height of the lower edge. An inner one has a door in its middle.
fn parts(is_outer: bool) -> Vec<(f32, f32, f32)> {
    if is_outer {
        return vec![(0.0, ROOM, 0.0)];
    }
    let [width, height] = DOOR;
    let beside = (ROOM - width) * 0.5;
    let aside = (width + beside) * 0.5;
    vec![
        (-aside, beside, 0.0),
        (aside, beside, 0.0),
        (0.0, width, height),
    ]
}

/// A number from 0 to 1, the same in each run.
fn dice(number: u32, throw: u32) -> f32 {
    let mut mixed = number.wrapping_mul(0x9e37_79b9) ^ throw.wrapping_mul(0x85eb_ca6b);
    mixed = (mixed ^ mixed >> 15).wrapping_mul(0x2c1b_3c6d);
    mixed = (mixed ^ mixed >> 12).wrapping_mul(0x297a_2d39);
    ((mixed ^ mixed >> 15) >> 8) as f32 / (1u32 << 24) as f32
}
