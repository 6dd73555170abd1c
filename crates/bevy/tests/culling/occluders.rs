//! Tagged occluders: what hides from cameras whose depth is not read, and from lights.

use antumbra_bevy::{AntumbraCulling, Occluder, Occluders, ShadowCulling, ShadowReport};
use bevy::camera::Viewport;
use bevy::camera::visibility::VisibilityRange;
use bevy::prelude::*;

use crate::play::{Paint, Play, boxed, differences, from};
use crate::{BEHIND, SIZE};

fn tagged() -> AntumbraCulling {
    AntumbraCulling {
        occluders: Occluders::Tagged,
        ..default()
    }
}

#[test]
fn only_what_is_tagged_hides() {
    let mut play = Play::with([160, 120], (tagged(), Msaa::default()));
    let wall = play.add_wall();
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    play.settle();
    assert!(play.report().age.is_some() && !play.culls(red));
    play.set(wall, Occluder::default());
    play.settle();
    assert!(play.culls(red) && !play.culls(wall));
    assert_eq!(play.report().fault, None);
    // As with the camera's own depth, what is not drawn hides nothing.
    play.set(wall, Visibility::Hidden);
    play.settle();
    assert!(!play.culls(red) && play.seen(Paint::Red) > 20);
    play.set(wall, Visibility::Inherited);
    play.settle();
    assert!(play.culls(red));
    // Neither does what is faded.
    play.set(
        wall,
        VisibilityRange {
            start_margin: 0.0..0.0,
            end_margin: 50.0..90.0,
            use_aabb: false,
        },
    );
    play.settle();
    assert!(!play.culls(red));
    play.app
        .world_mut()
        .entity_mut(wall)
        .remove::<VisibilityRange>();
    play.settle();
    assert!(play.culls(red));
}

#[test]
fn a_simpler_mesh_hides_in_place_of_the_own_one() {
    let mut play = Play::with([160, 120], (tagged(), Msaa::Off));
    let wall = play.add_wall();
    // Half as wide and high as the wall.
    let simpler = Mesh::from(Cuboid::from_length(0.5));
    let simpler = play
        .app
        .world_mut()
        .resource_mut::<Assets<Mesh>>()
        .add(simpler);
    play.set(
        wall,
        Occluder {
            mesh: Some(simpler),
        },
    );
    let red = play.add(Paint::Red, boxed(BEHIND, SIZE));
    let blue = play.add(Paint::Blue, boxed([3.0, 0.0, -3.0], SIZE));
    play.settle();
    assert!(play.culls(red) && !play.culls(blue));
}

/// What is in a room, and what is behind it.
struct Room {
    play: Play,
    walls: Entity,
    inside: Entity,
    behind: Entity,
}

impl Room {
    /// A box that the camera looks at from outside, tagged. `sign`: that of its size along one axis.
    fn new(sign: f32) -> Self {
        let mut play = Play::with([160, 120], (tagged(), Msaa::Off));
        let walls = play.add(Paint::Grey, boxed([0.0; 3], [sign * 9.0, 9.0, 9.0]));
        play.set(walls, Occluder::default());
        let inside = play.add(Paint::Red, boxed([0.0; 3], SIZE));
        let behind = play.add(Paint::Blue, boxed([0.0, 0.0, -8.0], SIZE));
        play.settle();
        Self {
            play,
            walls,
            inside,
            behind,
        }
    }

    fn material(&mut self) -> Handle<StandardMaterial> {
        let world = self.play.app.world();
        let material = world.get::<MeshMaterial3d<StandardMaterial>>(self.walls);
        material.unwrap().0.clone()
    }
}

#[test]
fn what_is_mirrored_hides_with_the_faces_that_bevy_draws() {
    let plain = Room::new(1.0);
    assert!(plain.play.culls(plain.inside) && plain.play.culls(plain.behind));
    // Bevy draws the far walls of a mirror image.
    let Room {
        play,
        inside,
        behind,
        ..
    } = Room::new(-1.0);
    assert!(play.seen(Paint::Red) > 20 && play.seen(Paint::Blue) == 0);
    assert!(!play.culls(inside) && play.culls(behind));
}

#[test]
fn what_shows_its_faces_from_behind_hides_nothing() {
    let mut room = Room::new(1.0);
    assert!(room.play.culls(room.inside));
    let material = room.material();
    let world = room.play.app.world_mut();
    let mut materials = world.resource_mut::<Assets<StandardMaterial>>();
    let mut material = materials.get_mut(&material).unwrap();
    material.cull_mode = Some(bevy::render::render_resource::Face::Front);
    drop(material);
    room.play.settle();
    assert!(room.play.seen(Paint::Red) > 20);
    assert!(!room.play.culls(room.inside) && !room.play.culls(room.behind));
    // A camera that turns all faces round says that it does not cull.
    let mut room = Room::new(1.0);
    let camera = room.play.camera;
    let world = room.play.app.world_mut();
    world.get_mut::<Camera>(camera).unwrap().invert_culling = true;
    room.play.settle();
    assert!(!room.play.culls(room.inside) && room.play.seen(Paint::Red) > 20);
    let fault = room.play.report().fault.clone().unwrap();
    assert!(fault.contains("invert_culling"), "{fault}");
}

#[test]
fn a_camera_that_draws_into_a_part_of_its_target_culls_by_tagged_occluders() {
    let [mut culled, mut full] = [true, false].map(|culls| {
        let mut play = Play::with([200, 150], Msaa::Sample4);
        crate::pictures::fill(&mut play);
        let camera = play.camera;
        play.set(camera, from([0.0, 0.5, 19.0]));
        let part = Viewport {
            physical_position: UVec2::new(30, 20),
            physical_size: UVec2::new(160, 120),
            ..default()
        };
        let world = play.app.world_mut();
        let mut meshes = world.query_filtered::<Entity, With<Mesh3d>>();
        let meshes: Vec<Entity> = meshes.iter(world).collect();
        for mesh in meshes {
            play.set(mesh, Occluder::default());
        }
        let world = play.app.world_mut();
        world.get_mut::<Camera>(camera).unwrap().viewport = Some(part);
        if culls {
            play.set(camera, tagged());
        }
        play
    });
    for frame in 0..5 {
        culled.frame();
        full.frame();
        let wrong = differences(&culled.pixels(), &full.pixels());
        assert_eq!(wrong, 0, "frame {frame}");
    }
    let left_out = culled.report().culled.len();
    assert!(left_out > 60, "{left_out}");
    assert_eq!(culled.report().fault, None);
}

#[test]
fn lights_leave_out_casters_that_are_hidden_from_them_and_shadows_stay() {
    let mut screens = Vec::new();
    let [mut culled, mut full] = [true, false].map(|culls| {
        let mut play = Play::with([200, 150], Msaa::Off);
        crate::pictures::fill(&mut play);
        play.set(play.camera, from([0.0, 6.0, 19.0]));
        // A screen before each lamp.
        let [lamp, spot] = [[2.0, 5.0, 3.0], [-11.0, 6.5, 5.5]].map(|at| {
            play.add(
                Paint::Grey,
                boxed(at, [3.0, 3.0, 0.2]).looking_at(Vec3::ZERO, Vec3::Y),
            )
        });
        for screen in [lamp, spot] {
            play.set(screen, Occluder::default());
        }
        screens.push(lamp);
        if culls {
            let world = play.app.world_mut();
            let mut lights =
                world.query_filtered::<Entity, Or<(With<PointLight>, With<SpotLight>)>>();
            let lights: Vec<Entity> = lights.iter(world).collect();
            for light in lights {
                play.set(light, ShadowCulling);
            }
        }
        play
    });
    let reports = |play: &mut Play| -> Vec<ShadowReport> {
        let world = play.app.world_mut();
        let mut reports = world.query::<&ShadowReport>();
        reports.iter(world).copied().collect()
    };
    for frame in 0..12 {
        // A screen that moves hides nothing where it was.
        if frame >= 6 {
            let at = [2.0 + 0.3 * frame as f32, 5.0, 3.0];
            let place = boxed(at, [3.0, 3.0, 0.2]).looking_at(Vec3::ZERO, Vec3::Y);
            culled.set(screens[0], place);
            full.set(screens[1], place);
        }
        culled.frame();
        full.frame();
        let wrong = differences(&culled.pixels(), &full.pixels());
        assert_eq!(wrong, 0, "frame {frame}");
        let reports = reports(&mut culled);
        assert_eq!(reports.len(), 2);
        if frame == 5 {
            assert!(
                reports.iter().all(|report| report.culled > 10),
                "{reports:?}"
            );
        }
    }
    assert!(reports(&mut full).is_empty());
}

#[test]
fn a_light_whose_occluder_was_away_for_a_moment_has_its_answers_at_once() {
    let mut play = Play::with([160, 120], Msaa::Off);
    let screen = play.add(Paint::Grey, boxed([0.0; 3], [8.0, 8.0, 0.5]));
    play.set(screen, Occluder::default());
    play.add(Paint::Red, boxed(BEHIND, SIZE));
    let spot = SpotLight {
        shadow_maps_enabled: true,
        range: 40.0,
        ..default()
    };
    let light = play
        .app
        .world_mut()
        .spawn((spot, ShadowCulling, from([0.0, 1.0, 14.0])))
        .id();
    let culled = |play: &Play| play.app.world().get::<ShadowReport>(light).unwrap().culled;
    play.settle();
    assert_eq!(culled(&play), 1);
    play.set(screen, Visibility::Hidden);
    for _ in 0..3 {
        play.frame();
        assert_eq!(culled(&play), 0);
    }
    play.set(screen, Visibility::Inherited);
    play.frame();
    assert_eq!(culled(&play), 1);
}
