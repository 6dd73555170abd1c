//! Pictures with the plug-in and without: the same, with shadows of all kinds of lights.

use antumbra_bevy::{AntumbraCulling, Audit, Budget};
use bevy::core_pipeline::prepass::DepthPrepass;
use bevy::prelude::*;

use crate::play::{Paint, Play, boxed, differences, from};

/// Numbers that are the same in each run.
struct Dice(u32);

impl Dice {
    fn within(&mut self, least: f32, most: f32) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        least + (most - least) * (self.0 >> 8) as f32 / (1u32 << 24) as f32
    }
}

/// Boxes of all sizes on a floor, and lights that cast shadows.
pub fn fill(play: &mut Play) {
    let mut dice = Dice(5);
    let world = play.app.world_mut();
    let cube = world
        .resource_mut::<Assets<Mesh>>()
        .add(Cuboid::from_length(1.0));
    let mut materials = world.resource_mut::<Assets<StandardMaterial>>();
    let paints: Vec<_> = (0..8)
        .map(|number| materials.add(Color::hsl(45.0 * number as f32, 0.8, 0.6)))
        .collect();
    for number in 0..250 {
        let size = [
            dice.within(0.3, 2.5),
            dice.within(0.5, 6.0),
            dice.within(0.3, 2.5),
        ];
        let place = boxed(
            [
                dice.within(-14.0, 14.0),
                size[1] * 0.5 - 2.0,
                dice.within(-14.0, 14.0),
            ],
            size,
        );
        let turned = place.with_rotation(Quat::from_rotation_y(dice.within(0.0, 6.0)));
        let paint = MeshMaterial3d(paints[number % paints.len()].clone());
        world.spawn((Mesh3d(cube.clone()), paint, turned));
    }
    let floor = boxed([0.0, -2.05, 0.0], [60.0, 0.1, 60.0]);
    let paint = MeshMaterial3d(paints[0].clone());
    world.spawn((Mesh3d(cube), paint, floor));
    let sun = DirectionalLight {
        shadow_maps_enabled: true,
        illuminance: 4_000.0,
        ..default()
    };
    world.spawn((sun, from([4.0, 9.0, -6.0])));
    let lamp = PointLight {
        shadow_maps_enabled: true,
        intensity: 2_000_000.0,
        ..default()
    };
    world.spawn((lamp, Transform::from_xyz(3.0, 6.0, 4.0)));
    let spot = SpotLight {
        shadow_maps_enabled: true,
        intensity: 2_000_000.0,
        range: 40.0,
        ..default()
    };
    world.spawn((spot, from([-12.0, 8.0, 6.0])));
}

#[test]
fn a_still_camera_draws_the_same_picture_with_shadows_of_all_lights() {
    for (msaa, has_prepass) in [
        (Msaa::Sample4, false),
        (Msaa::Off, false),
        (Msaa::Sample4, true),
    ] {
        let [mut culled, mut full] = [true, false].map(|culls| {
            let mut play = Play::with([200, 150], msaa);
            fill(&mut play);
            let camera = play.camera;
            play.set(camera, from([0.0, 0.5, 19.0]));
            if culls {
                play.set(camera, AntumbraCulling::default());
            }
            if has_prepass {
                play.set(camera, DepthPrepass);
            }
            play
        });
        for frame in 0..5 {
            culled.frame();
            full.frame();
            let wrong = differences(&culled.pixels(), &full.pixels());
            assert_eq!(wrong, 0, "{msaa:?}, frame {frame}");
        }
        let left_out = culled.report().culled.len();
        assert!(left_out > 60, "{left_out}");
    }
}

#[test]
fn lights_that_light_nothing_in_sight_go_and_the_picture_stays() {
    let [mut culled, mut full] = [true, false].map(|culls| {
        let mut play = Play::with(
            [200, 150],
            AntumbraCulling {
                lights: culls,
                ..default()
            },
        );
        fill(&mut play);
        // A wall across the view, and lamps behind it that do not reach through.
        play.add(Paint::Grey, boxed([0.0, 3.0, 14.0], [40.0, 12.0, 0.3]));
        for x in [-3.0, 0.0, 3.0] {
            let lamp = PointLight {
                range: 3.0,
                shadow_maps_enabled: true,
                ..default()
            };
            let place = Transform::from_xyz(x, 1.0, 4.0);
            play.app.world_mut().spawn((lamp, place));
        }
        let camera = play.camera;
        play.set(camera, from([0.0, 1.0, 22.0]));
        play
    });
    for frame in 0..5 {
        culled.frame();
        full.frame();
        assert_eq!(
            differences(&culled.pixels(), &full.pixels()),
            0,
            "frame {frame}"
        );
    }
    assert_eq!((culled.report().lights, full.report().lights), (3, 0));
    // Where cameras do not ask any more, there is nothing to report.
    let settings = culled
        .app
        .world()
        .get::<AntumbraCulling>(culled.camera)
        .cloned();
    culled.set(culled.camera, AntumbraCulling::default());
    culled.frame();
    assert_eq!(culled.report().lights, 0);
    culled.set(culled.camera, settings.unwrap());
    // They are back at once when the camera is behind the wall.
    for play in [&mut culled, &mut full] {
        let camera = play.camera;
        play.set(camera, from([0.0, 6.0, -12.0]));
        play.frame();
    }
    assert_eq!(culled.report().lights, 0);
    assert_eq!(differences(&culled.pixels(), &full.pixels()), 0);
}

#[test]
fn an_audit_counts_the_pixels_that_are_wrong_in_a_flight() {
    let budget = Budget::Shift(1.0);
    let audit = Audit::Every(1);
    let settings = AntumbraCulling {
        budget,
        audit,
        ..default()
    };
    let [mut culled, mut full] = [true, false].map(|culls| {
        let mut play = Play::with([200, 150], Msaa::Off);
        fill(&mut play);
        if culls {
            let camera = play.camera;
            play.set(camera, settings.clone());
        }
        play
    });
    let mut wrong = Vec::new();
    let mut told = Vec::new();
    for step in 0..40 {
        let angle = 0.06 * step as f32;
        for play in [&mut culled, &mut full] {
            let camera = play.camera;
            play.set(camera, from([16.0 * angle.sin(), 1.0, 16.0 * angle.cos()]));
            play.frame();
        }
        wrong.push(differences(&culled.pixels(), &full.pixels()));
        let report = culled.report();
        if told.len() < report.audits as usize {
            // Bevy shows the report's share in percent; this is in pixels.
            told.push((report.wrong.unwrap() * 300.0).round() as usize);
        }
    }
    assert!(told.len() > 8, "{}", told.len());
    // Each count is that of a frame, in order. A pixel in which a mesh is missing may show the same colour by chance.
    let mut frames = wrong.iter();
    for count in &told {
        let is_close = |frame: &&usize| count.abs_diff(**frame) <= 2 + *count / 50;
        assert!(
            frames.any(|frame| is_close(&frame)),
            "{count} in {wrong:?}, told {told:?}"
        );
    }
    assert!(
        told.iter().any(|count| *count > 0),
        "nothing was wrong: {wrong:?}"
    );
}

#[test]
fn a_budget_of_wrong_pixels_is_kept_on_a_flight() {
    let audit = Audit::Every(1);
    let settings = AntumbraCulling { audit, ..default() };
    let [mut culled, mut full] = [true, false].map(|culls| {
        let mut play = Play::with([200, 150], Msaa::Sample4);
        fill(&mut play);
        if culls {
            let camera = play.camera;
            play.set(camera, settings.clone());
        }
        play
    });
    let (mut wrong, mut left_out) = (0, 0);
    let steps = 60;
    for step in 0..steps {
        let angle = 0.01 * step as f32;
        for play in [&mut culled, &mut full] {
            let camera = play.camera;
            play.set(camera, from([18.0 * angle.sin(), 1.0, 18.0 * angle.cos()]));
            play.frame();
        }
        wrong += differences(&culled.pixels(), &full.pixels());
        left_out += culled.report().culled.len();
    }
    let percent = 100.0 * wrong as f64 / (200.0 * 150.0 * f64::from(steps));
    assert!(percent < 0.02, "{percent} %");
    assert!(left_out / steps as usize > 20, "{left_out}");
}
