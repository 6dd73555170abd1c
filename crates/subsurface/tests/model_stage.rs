//! Presentation of the built-in model: wells, colours, lights, viewpoints and the flight.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_demo_scenes::subsurface::{FlightPoint, Model, ModelLight, ModelOptions};
use antumbra_scene::{Camera, Projection, Scene};
use glam::{DAffine3, DVec2, DVec3};
use std::collections::HashMap;

fn model(nodes_per_side: u32, seed: u64) -> Model {
    let options = ModelOptions {
        nodes_per_side,
        seed,
        ..ModelOptions::default()
    };
    Model::new(&options).unwrap()
}

#[test]
fn wells_are_closed_tubes_inside_the_volume() {
    for seed in 1..8 {
        let wells = model(200, seed).wells();
        assert_eq!(wells.len(), 4);
        for well in wells {
            let geometry = &well.geometry;
            assert_eq!(geometry.problem(), None);
            assert!((200..3000).contains(&geometry.triangle_count()));
            let mut sides: HashMap<(u32, u32), i32> = HashMap::new();
            let mut space = 0.0;
            for [a, b, c] in geometry.triangles() {
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    *sides.entry((from.min(to), from.max(to))).or_default() +=
                        if from < to { 1 } else { -1 };
                }
                let [a, b, c] = geometry.corners([a, b, c]).unwrap();
                space += a.dot(b.cross(c));
            }
            assert!(
                sides.values().all(|turns| *turns == 0),
                "{} is open",
                well.name
            );
            assert!(space > 0.0, "{} is inside out", well.name);
            let bounds = geometry.bounds().unwrap();
            let (min, max) = (well.origin + bounds.min, well.origin + bounds.max);
            assert!(min.x > -3275.0 && max.x < 3275.0, "{seed}: {min} {max}");
            assert!(min.z > -2962.5 && max.z < 2962.5, "{seed}: {min} {max}");
            assert!(min.y > -3000.0 && max.y < 50.0, "{seed}: {min} {max}");
            assert!(max.y - min.y > 1500.0);
        }
    }
}

#[test]
fn a_scene_takes_the_lamps() {
    let mut scene = Scene::new();
    for ModelLight { position, light } in model(2, 1).lights() {
        assert!(position.y > 0.0);
        let lamp = scene
            .spawn(None, DAffine3::from_translation(position))
            .unwrap();
        scene.set_light(lamp, light).unwrap();
    }
}

#[test]
fn views_see_the_model_from_outside() {
    let model = model(2, 1);
    let views = model.views();
    assert_eq!(views.map(|view| view.name), ["open", "occluded"]);
    for view in views {
        let projection = Projection::Perspective {
            fov_y: view.fov_y,
            near: 1.0,
        };
        let camera = Camera::look_at(view.position, view.target, DVec3::Y, projection).unwrap();
        let model = antumbra_scene::Aabb {
            min: DVec3::new(-3275.0, -3000.0, -2962.5),
            max: DVec3::new(3275.0, 0.0, 2962.5),
        };
        assert!(!model.contains(view.position));
        assert!(model.contains(view.target));
        assert!(camera.frustum(1.25).intersects(&model));
    }
}

#[test]
fn the_flight_goes_around_and_between_the_layers() {
    for seed in 1..6 {
        let model = model(2, seed);
        let mut between = 0;
        for FlightPoint { eye, target } in model.flight() {
            assert!(eye.distance(target) > 100.0);
            let place = DVec2::new(eye.x, -eye.z);
            if place.abs().cmpgt(DVec2::new(3275.0, 2962.5)).any() {
                continue;
            }
            let depths: Vec<f64> = (0..11).filter_map(|k| model.depth(k, place)).collect();
            let above = depths.iter().filter(|depth| **depth < -eye.y).count();
            let clear = depths.iter().all(|depth| (depth + eye.y).abs() > 20.0);
            assert!(clear, "{seed}: the eye at {eye} touches a horizon");
            between += usize::from(above > 0 && above < depths.len());
        }
        assert!(
            between >= 3,
            "{seed}: only {between} points lie between horizons"
        );
    }
}
