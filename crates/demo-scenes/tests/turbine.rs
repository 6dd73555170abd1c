//! The built-in engine: its number of parts and triangles, closed parts that face outwards, openings that show the
//! inside, and about a third of the parts visible from outside.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "turbine/picture.rs"]
mod picture;
#[path = "turbine/ray.rs"]
mod ray;
#[path = "turbine/shells.rs"]
mod shells;

use antumbra_demo_scenes as demo_scenes;
use antumbra_demo_scenes::{DemoSceneError, TurbineOptions, turbine};
use antumbra_scene::{EntityKey, Light, Scene};
use glam::{DAffine3, DVec3};
use picture::{View, picture};
use ray::first_on;
use std::collections::HashSet;
use std::f64::consts::TAU;

const SIZES: [u32; 2] = [1, 2];

fn engine(size: u32, seed: u64) -> Scene {
    let mut scene = turbine(TurbineOptions { size, seed }).unwrap();
    scene.update();
    scene
}

/// The name of the parent of a part.
fn module(scene: &Scene, part: EntityKey) -> &str {
    scene.entity_name(scene.parent(part).unwrap())
}

/// Vertices of every part as placed.
fn places(scene: &Scene) -> impl Iterator<Item = (EntityKey, DVec3)> {
    scene.drawables().flat_map(|(part, drawable)| {
        let world = scene.world(part).unwrap();
        let geometry = scene.mesh(drawable.mesh).unwrap().full().unwrap();
        let corners = geometry.positions.iter();
        corners.map(move |p| (part, world.transform_point3(DVec3::from(p.map(f64::from)))))
    })
}

fn radius(place: DVec3) -> f64 {
    place.y.hypot(place.z)
}

#[test]
fn it_has_as_many_parts_and_triangles_as_it_says() {
    for (size, parts, triangles) in [(1, 2_000, 1.6e6), (2, 4_000, 2.9e6)] {
        for seed in [1, 2, 77, u64::MAX] {
            let scene = engine(size, seed);
            assert_eq!(scene.drawable_count(), parts, "size {size}, seed {seed}");
            let share = scene.triangle_count() as f64 / triangles;
            assert!((share - 1.0).abs() < 0.01, "size {size}: {share}");
            assert!(scene.mesh_count() * 10 < parts, "parts share meshes");
            let placed: HashSet<_> = scene.drawables().map(|(_, d)| d.mesh).collect();
            assert_eq!(placed.len(), scene.mesh_count(), "every mesh is placed");
        }
    }
}

#[test]
fn names_and_sizes() {
    assert!(demo_scenes::names().contains(&"turbine"));
    let count = |size| {
        demo_scenes::by_name("turbine", size)
            .unwrap()
            .drawable_count()
    };
    assert_eq!([None, Some(1), Some(2)].map(count), [2_000, 2_000, 4_000]);
    for size in [0, 3, u32::MAX] {
        let error = demo_scenes::by_name("turbine", Some(size)).unwrap_err();
        let text = error.to_string();
        assert!(
            text.contains(&size.to_string()) && text.contains("1 to 2"),
            "{text}"
        );
        assert!(matches!(error, DemoSceneError::NoSuchSize { .. }));
    }
}

#[test]
fn metal_stands_in_a_workshop_with_light_from_above() {
    let scene = engine(1, 1);
    let around = scene.environment().unwrap();
    let image = scene.image(around.image).unwrap();
    assert_eq!((image.width, image.height), (256, 128));
    let mean = |rows: std::ops::Range<u32>| {
        let row = image.width as usize * 4;
        let bytes = &image.rgba[rows.start as usize * row..rows.end as usize * row];
        bytes.iter().map(|b| f64::from(*b)).sum::<f64>() / bytes.len() as f64
    };
    let [ceiling, walls, floor] = [mean(0..32), mean(32..96), mean(96..128)];
    assert!(
        ceiling > walls && walls > floor,
        "{ceiling} {walls} {floor}"
    );
    let panels = image.rgba.chunks_exact(4).filter(|p| p[0] == 255).count();
    assert!(panels > 500, "{panels} pixels of light panels");
    let metals = scene.materials().filter(|(_, m)| m.metallic > 0.5).count();
    assert!(metals > 10 && metals < scene.materials().count());
    for (_, material) in scene.materials() {
        let (name, shine) = (&material.name, [material.metallic, material.roughness]);
        assert!(
            shine.iter().all(|n| (0.0..=1.0).contains(n)),
            "{name}: {shine:?}"
        );
    }
    assert_eq!(
        engine(1, 2).image(around.image),
        Some(image),
        "whatever the seed"
    );
}

#[test]
fn one_seed_is_one_engine_and_another_moves_pipes_and_brackets_alone() {
    let everything = |seed| -> Vec<(String, DAffine3, Vec<[f32; 3]>)> {
        let scene = engine(1, seed);
        let parts = scene.drawables().map(|(part, drawable)| {
            let mesh = scene.mesh(drawable.mesh).unwrap();
            let positions = mesh.full().unwrap().positions.clone();
            let name = format!("{}: {}", module(&scene, part), scene.entity_name(part));
            (name, scene.world(part).unwrap(), positions)
        });
        parts.collect()
    };
    let one = everything(5);
    assert!(one == everything(5), "one seed, one engine");
    let other = everything(6);
    let by_chance =
        |part: &&(String, _, _)| part.0.starts_with("pipes") || part.0.starts_with("brackets");
    let [moved, kept]: [Vec<_>; 2] = [true, false].map(|chance| {
        let both = one.iter().zip(&other);
        both.filter(|(part, _)| by_chance(part) == chance).collect()
    });
    assert!(kept.iter().all(|(a, b)| a == b));
    let same = moved.iter().filter(|(a, b)| a == b).count();
    assert_eq!(same, 0, "of {}", moved.len());
}

#[test]
fn parts_are_closed_and_look_outwards() {
    for (size, seed) in [(1, 1), (1, 2), (1, 3), (2, 4)] {
        for (_, mesh) in engine(size, seed).meshes() {
            shells::assert_closed_and_outward(mesh);
        }
    }
}

#[test]
fn everything_lies_where_an_engine_has_it() {
    for size in SIZES {
        let scene = engine(size, 3);
        let bounds = scene.bounds().unwrap();
        let length = bounds.max.x - bounds.min.x;
        assert!((3.9..4.2).contains(&length), "{length} m long");
        let mut tips: f64 = 0.0;
        for (part, place) in places(&scene) {
            let (away, name) = (radius(place), scene.entity_name(part));
            assert!(away < 1.75, "{name} is {away} m from the axis");
            // Inside the casing, whose radius is smallest at x = 0.28.
            let within = match module(&scene, part) {
                "fan blades" => 1.44,
                "compressor blades" => 0.75,
                "turbine blades" => 0.78,
                "rotor" | "shafts" => 0.465,
                "pipes" | "brackets" => {
                    let least = if place.x < -0.95 { 1.46 } else { 0.58 };
                    assert!(away > least, "{name} is within the casing, {away} m");
                    1.75
                }
                _ => 1.75,
            };
            assert!(away < within, "{name} is {away} m from the axis");
            if module(&scene, part) == "fan blades" {
                tips = tips.max(away);
            }
        }
        assert!(tips > 1.4, "the fan fills its casing: {tips}");
    }
}

/// Axial ranges of openings, and the angles of their centres in degrees.
const OPENINGS: [([f64; 2], [f64; 2]); 5] = [
    ([-1.66, -1.12], [90.0, 270.0]),
    ([-0.52, -0.23], [75.0, 285.0]),
    ([-0.07, 0.20], [75.0, 285.0]),
    ([0.36, 0.77], [75.0, 285.0]),
    ([0.93, 1.37], [75.0, 285.0]),
];

#[test]
fn one_sees_in_through_openings_and_only_there() {
    let inside = [
        "fan blades",
        "outlet vanes",
        "compressor blades",
        "compressor vanes",
        "rotor",
        "shafts",
        "combustor",
        "turbine blades",
        "turbine vanes",
    ];
    for (size, seed) in [(1, 1), (1, 2), (2, 1), (2, 9)] {
        let scene = engine(size, seed);
        let look = |x: f64, degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let (outwards, from) = (DVec3::new(0.0, cos, sin), 3.0);
            let eye = DVec3::new(x, 0.0, 0.0) + outwards * from;
            let (part, distance) = first_on(&scene, eye, -outwards).unwrap();
            let name = format!("{}, {}", module(&scene, part), scene.entity_name(part));
            (
                inside.contains(&module(&scene, part)),
                from - distance,
                name,
            )
        };
        for ([front, rear], angles) in OPENINGS {
            for angle in angles {
                let x = 0.5 * (front + rear);
                let (within, height, name) = look(x, angle);
                assert!(within, "at {x} m, {angle} degrees {name} is in the way");
                assert!(height > 0.0, "{name} lies on the other side");
                let around = [-36.0, 36.0].map(|beside| (x, angle + beside));
                let along = [front - 0.04, rear + 0.04].map(|x| (x, angle));
                for (x, angle) in around.into_iter().chain(along) {
                    let (within, _, name) = look(x, angle);
                    assert!(!within, "{name} is seen at {x} m, {angle} degrees");
                }
            }
        }
    }
}

#[test]
fn from_outside_a_fifth_to_a_half_of_the_parts_is_seen() {
    for size in SIZES {
        let scene = engine(size, 1);
        let bounds = scene.bounds().unwrap();
        let fov_y = 45_f64.to_radians();
        // The camera's distance fits the bounding sphere of the engine; it looks from 20 degrees above.
        let away = 1.05 * bounds.half_extents().length() / (0.5 * fov_y).sin();
        for eighth in [0, 1, 3, 6] {
            let (sin, cos) = (TAU * f64::from(eighth) / 8.0).sin_cos();
            let (rise, level) = 20_f64.to_radians().sin_cos();
            let view = View {
                eye: bounds.centre() + DVec3::new(sin * level, rise, cos * level) * away,
                target: bounds.centre(),
                fov_y,
                size: [1280, 1024],
            };
            let pixels = picture(&scene, &view);
            let rows: Vec<_> = pixels.chunks(1280).collect();
            let border = rows
                .iter()
                .flat_map(|row| [row.first(), row.last()].map(Option::unwrap));
            let border = border.chain(rows[0]).chain(rows[1023]);
            assert!(border.into_iter().all(Option::is_none), "the whole is seen");
            let seen: HashSet<_> = pixels.iter().flatten().collect();
            let share = seen.len() as f64 / scene.drawable_count() as f64;
            assert!(
                (0.2..0.5).contains(&share),
                "size {size}, eighth {eighth}: {share}"
            );
        }
    }
}

#[test]
fn four_lamps_stand_around_it() {
    let scene = engine(1, 1);
    let lamps: Vec<_> = scene.lights().collect();
    assert_eq!(lamps.len(), 4);
    for lamp in lamps {
        assert!(matches!(lamp.light, Light::Point { .. }));
        assert!(radius(lamp.world.translation) > 2.0, "outside the engine");
    }
    let looks: HashSet<_> = scene.drawables().map(|(_, d)| d.material).collect();
    assert!(
        looks.len() >= 20,
        "parts of a kind look alike, kinds differ"
    );
}
