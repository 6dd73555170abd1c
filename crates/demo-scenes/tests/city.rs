//! The built-in city: its number of triangles under every seed, its hierarchy, closed parts that face outwards, walls
//! that hide everything except behind windows and doors, and vehicles on the road.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "turbine/ray.rs"]
mod ray;
#[path = "turbine/shells.rs"]
mod shells;

use antumbra_demo_scenes as demo_scenes;
use antumbra_demo_scenes::{CityOptions, DemoSceneError, city};
use antumbra_scene::{Aabb, EntityKey, Light, Scene};
use glam::{DAffine3, DVec3};
use std::collections::HashSet;

/// Triangles of the city of Staneker, Bartz and Straßer.
const TRIANGLES: f64 = 64_898_464.0;
/// Half the edge of a block, and half the width of a roadway.
const BLOCK: f64 = 35.0;
const ROADWAY: f64 = 6.0;

fn built(size: u32, seed: u64) -> Scene {
    let mut scene = city(CityOptions { size, seed }).unwrap();
    scene.update();
    scene
}

/// The nodes whose name is a word, or starts with it before a number.
fn named<'a>(scene: &'a Scene, word: &'a str) -> impl Iterator<Item = EntityKey> + 'a {
    scene.entities().filter(move |entity| {
        let rest = scene.entity_name(*entity).strip_prefix(word);
        rest.is_some_and(|rest| rest.trim().chars().all(|c| c.is_ascii_digit()))
    })
}

fn vehicles(scene: &Scene) -> Vec<EntityKey> {
    let words = ["saloon", "van", "racing car"];
    words.iter().flat_map(|word| named(scene, word)).collect()
}

fn apart(a: &Aabb, b: &Aabb) -> bool {
    a.max.cmple(b.min).any() || b.max.cmple(a.min).any()
}

#[test]
fn the_default_has_as_many_triangles_as_it_says_under_every_seed() {
    for seed in [1, 2, 77, u64::MAX] {
        let defaults = CityOptions::default();
        let scene = city(CityOptions { seed, ..defaults }).unwrap();
        let share = scene.triangle_count() as f64 / TRIANGLES;
        assert!((share - 1.0).abs() < 0.01, "seed {seed}: {share}");
        let drawables = scene.drawable_count();
        assert!((40_000..120_000).contains(&drawables), "{drawables}");
        let unique: usize = scene.meshes().map(|(_, mesh)| mesh.triangle_count()).sum();
        assert!(scene.mesh_count() <= 400 && unique <= 600_000);
        let placed: HashSet<_> = scene.drawables().map(|(_, d)| d.mesh).collect();
        assert_eq!(placed.len(), scene.mesh_count(), "every mesh is placed");
    }
}

#[test]
fn names_and_sizes() {
    assert!(demo_scenes::names().contains(&"city"));
    let count = |size| demo_scenes::by_name("city", size).unwrap().triangle_count();
    let counts = [Some(1), Some(2), Some(3), None].map(count);
    assert!(counts.is_sorted(), "{counts:?}");
    assert!(counts[0] < 2_000_000, "small enough for tests: {counts:?}");
    for size in [0, 17, u32::MAX] {
        let error = demo_scenes::by_name("city", Some(size)).unwrap_err();
        let text = error.to_string();
        assert!(
            text.contains(&size.to_string()) && text.contains("1 to 16"),
            "{text}"
        );
        assert!(matches!(error, DemoSceneError::NoSuchSize { .. }));
    }
}

#[test]
fn one_seed_is_one_city_and_another_has_other_houses() {
    let everything = |seed| -> Vec<(String, String, DAffine3)> {
        let scene = built(2, seed);
        let pieces = scene.drawables().map(|(piece, drawable)| {
            let look = &scene.material(drawable.material).unwrap().name;
            let mesh = &scene.mesh(drawable.mesh).unwrap().name;
            (mesh.clone(), look.clone(), scene.world(piece).unwrap())
        });
        pieces.collect()
    };
    let one = everything(5);
    assert!(one == everything(5), "one seed, one city");
    let other = everything(6);
    let same = one.iter().zip(&other).filter(|(a, b)| a == b).count();
    assert!(same * 2 < one.len(), "{same} of {} are the same", one.len());
}

#[test]
fn every_leaf_is_a_piece_or_the_sun_and_no_node_has_too_many_children() {
    for size in [1, 5, 7] {
        let scene = built(size, 1);
        let mut suns = 0;
        for entity in scene.entities() {
            let children = scene.children(entity).count();
            let what = scene.describe(entity);
            assert!(children <= 64, "{what} has {children} children");
            if children > 0 {
                assert!(scene.drawable(entity).is_none(), "{what} is drawn");
                assert!(!scene.entity_name(entity).is_empty(), "a node has a name");
            } else if scene.drawable(entity).is_none() {
                assert_eq!(scene.entity_name(entity), "sun");
                suns += 1;
            }
        }
        assert_eq!(suns, 1);
        assert_eq!(scene.roots().count(), 2, "the city and its sun");
    }
}

#[test]
fn pieces_hang_below_rooms_storeys_houses_lots_blocks_and_quarters() {
    let scene = built(2, 1);
    let above = |entity: EntityKey| {
        let ways = std::iter::successors(Some(entity), |entity| scene.parent(*entity));
        let names = ways.map(|entity| scene.entity_name(entity).to_owned());
        names.skip(1).collect::<Vec<_>>()
    };
    let find = |mesh: &str| {
        let is = |key| scene.mesh(key).unwrap().name == mesh;
        let mut pieces = scene.drawables().filter(|(_, drawable)| is(drawable.mesh));
        above(pieces.next().unwrap().0)
    };
    let sofa = find("sofa");
    let words = ["living room", "storey", "house", "lot", "block", "quarter"];
    for (name, word) in sofa.iter().zip(words) {
        assert!(name.starts_with(word), "{sofa:?}");
    }
    assert_eq!(sofa.last().unwrap(), "city");
    let tyre = find("tyre");
    assert!(tyre[0].ends_with("wheel") && ["saloon", "van"].contains(&tyre[1].as_str()));
    assert!(
        tyre[2].starts_with("stretch") && tyre[3].contains("street"),
        "{tyre:?}"
    );
}

#[test]
fn pieces_are_closed_and_look_outwards() {
    for (_, mesh) in city(CityOptions::default()).unwrap().meshes() {
        shells::assert_closed_and_outward(mesh);
    }
}

#[test]
fn walls_hide_the_rooms_but_for_windows_and_no_view_goes_through_a_block() {
    for seed in [1, 2] {
        let scene = built(1, seed);
        let (mut walls, mut rooms, mut looks) = (0, 0, 0);
        for step in 0..135 {
            let x = -33.5 + 0.5 * f64::from(step);
            let from = DVec3::new(x, 1.9, BLOCK + 0.6);
            let (_, away) = ray::first_on(&scene, from, DVec3::NEG_Z).unwrap();
            looks += 1;
            walls += usize::from(away < 0.95);
            rooms += usize::from(away >= 0.95);
            assert!(away < 2.0 * BLOCK, "seed {seed}, {x}: through the block");
        }
        let share = f64::from(rooms as u32) / f64::from(looks);
        assert!(
            (0.08..0.5).contains(&share),
            "seed {seed}: {walls} walls, {rooms} rooms"
        );
    }
}

#[test]
fn roofs_hide_the_rooms_from_above() {
    let scene = built(1, 1);
    for house in named(&scene, "house") {
        let middle = scene.world(house).unwrap().translation;
        let roof = named(&scene, "roof").find(|roof| scene.parent(*roof) == Some(house));
        let ceiling = scene.world(roof.unwrap()).unwrap().translation.y;
        for (x, z) in [
            (0.0, 0.0),
            (-6.0, 4.0),
            (5.0, -6.0),
            (3.0, 6.5),
            (-6.8, -6.8),
        ] {
            let from = DVec3::new(middle.x + x, 60.0, middle.z + z);
            let (_, away) = ray::first_on(&scene, from, DVec3::NEG_Y).unwrap();
            assert!(60.0 - away > ceiling, "over {}", scene.describe(house));
        }
    }
}

#[test]
fn vehicles_stand_on_the_road_beside_each_other() {
    for seed in [1, 9] {
        let scene = built(3, seed);
        let boxes: Vec<_> = (vehicles(&scene).into_iter())
            .map(|vehicle| (vehicle, scene.subtree_bounds(vehicle).unwrap()))
            .collect();
        assert!(boxes.len() > 40, "{} vehicles", boxes.len());
        for (i, (vehicle, bounds)) in boxes.iter().enumerate() {
            let what = scene.describe(*vehicle);
            assert!(
                (-0.01..0.04).contains(&bounds.min.y),
                "{what}: {}",
                bounds.min.y
            );
            let stretch = scene.parent(*vehicle).unwrap();
            let back = scene.world(stretch).unwrap().inverse();
            for corner in bounds.corners() {
                let place = back.transform_point3(corner);
                assert!(
                    place.x.abs() < ROADWAY && place.z.abs() < BLOCK,
                    "{what}: {place}"
                );
            }
            for (_, other) in &boxes[..i] {
                assert!(apart(bounds, other), "{what} runs into another");
            }
        }
    }
}

#[test]
fn trees_stand_outside_houses() {
    let scene = built(3, 4);
    let houses: Vec<_> = named(&scene, "house")
        .map(|house| scene.subtree_bounds(house).unwrap())
        .collect();
    let trees: Vec<_> = named(&scene, "tree").collect();
    assert!(trees.len() > 50, "{} trees", trees.len());
    for tree in trees {
        let bounds = scene.subtree_bounds(tree).unwrap();
        let clear = houses.iter().all(|house| apart(house, &bounds));
        assert!(clear, "a tree at {} grows into a house", bounds.centre());
    }
}

#[test]
fn the_sun_shines_on_a_few_opaque_materials() {
    let scene = built(2, 1);
    let lights: Vec<_> = scene.lights().collect();
    assert_eq!(lights.len(), 1);
    assert!(matches!(lights[0].light, Light::Directional { .. }));
    let sun = lights[0].world;
    assert!((sun.matrix3 * DVec3::NEG_Z).y < -0.5, "from above");
    let materials: Vec<_> = scene.materials().map(|(_, material)| material).collect();
    assert!((5..=15).contains(&materials.len()), "{}", materials.len());
    for material in materials {
        assert_eq!(material.base_colour[3], 1.0, "{}", material.name);
        let shine = [material.metallic, material.roughness];
        assert!(shine.iter().all(|n| (0.0..=1.0).contains(n)));
    }
    assert!(scene.environment().is_none() && scene.images().count() == 0);
}
