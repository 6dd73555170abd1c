//! CityJSON: the content of files is read, with +Y up, closed, and at its position.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_formats::{LoadOptions, SceneFormat, load, load_slice};
use antumbra_scene::{EntityKey, Geometry, Scene};
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use std::path::Path;

fn read(text: &str) -> Scene {
    load_slice(
        SceneFormat::CityJson,
        text.as_bytes(),
        None,
        &LoadOptions::default(),
    )
    .unwrap()
}

fn named(scene: &Scene, name: &str) -> EntityKey {
    let mut found = scene.entities().filter(|e| scene.entity_name(*e) == name);
    let entity = found.next().unwrap();
    assert!(found.next().is_none(), "two entities \"{name}\"");
    entity
}

/// The levels of detail of an entity's mesh.
fn levels<'a>(scene: &'a Scene, name: &str) -> &'a [Geometry] {
    let drawable = scene.drawable(named(scene, name)).unwrap();
    &scene.mesh(drawable.mesh).unwrap().levels
}

fn area(geometry: &Geometry) -> f64 {
    let triangles = geometry.triangles().map(|t| geometry.corners(t).unwrap());
    triangles
        .map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0)
        .sum()
}

/// Volume of a mesh; positive if its faces point outwards.
fn volume(geometry: &Geometry) -> f64 {
    let triangles = geometry.triangles().map(|t| geometry.corners(t).unwrap());
    triangles.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

/// Largest angle between a triangle's normal and those of its vertices; slivers are ignored.
fn least_agreement(geometry: &Geometry) -> f64 {
    let triangles = geometry.triangles().filter_map(|t| {
        let [a, b, c] = geometry.corners(t).unwrap();
        let faced = (b - a).cross(c - a);
        let stored = Vec3::from(geometry.normals[t[0] as usize]).as_dvec3();
        (faced.length() > 0.1).then(|| faced.normalize().dot(stored))
    });
    triangles.fold(1.0, f64::min)
}

#[test]
fn a_building_stands_upright_with_its_part_below_it() {
    let mut scene = read(common::CITY);
    assert_eq!(scene.len(), 2);
    assert_eq!(scene.drawable_count(), 1, "the footprint is left out");
    let (building, part) = (named(&scene, "a"), named(&scene, "a-0"));
    assert_eq!(scene.parent(part), Some(building));
    assert_eq!(scene.roots().collect::<Vec<_>>(), [building]);
    let at = scene.world(building).unwrap().translation;
    assert_eq!(at, DVec3::new(85_005.0, -2.0, -446_005.0));
    assert_eq!(scene.world(part).unwrap().translation, at);
    scene.update();
    let bounds = scene.bounds().unwrap();
    let (min, max) = (
        at - DVec3::new(5.0, 0.0, 5.0),
        at + DVec3::new(5.0, 10.0, 5.0),
    );
    assert!(bounds.min.abs_diff_eq(min, 1e-5) && bounds.max.abs_diff_eq(max, 1e-5));
    let drawable = scene.drawable(part).unwrap();
    let material = scene.material(drawable.material).unwrap();
    assert_eq!(material.name, "Building");
    assert!(material.double_sided, "not all of it is solid");
}

#[test]
fn levels_come_finest_first_with_holes_normals_and_tints() {
    let scene = read(common::CITY);
    let [fine, coarse] = levels(&scene, "a-0") else {
        panic!("two levels");
    };
    assert_eq!(coarse.triangle_count(), 12);
    assert!((volume(coarse) - 1000.0).abs() < 1e-6);
    assert_eq!(fine.triangle_count(), 10 + 8);
    assert!((area(fine) - (5.0 * 100.0 + 100.0 - 36.0)).abs() < 1e-6);
    for level in [fine, coarse] {
        assert!(least_agreement(level) > 0.999_999);
    }
    assert!(coarse.colours.is_empty());
    let (_, mesh) = scene.meshes().next().unwrap();
    let proxy = mesh.proxy.as_ref().unwrap();
    assert_eq!(proxy.positions, coarse.positions);
    assert_eq!(proxy.indices, coarse.indices);
    let up = |i: &usize| fine.normals[*i] == [0.0, 1.0, 0.0];
    let roof: Vec<_> = (0..fine.positions.len()).filter(up).collect();
    assert_eq!(roof.len(), 8);
    assert!(roof.iter().all(|i| fine.positions[*i][1] == 10.0));
    let tint = |i: usize| fine.colours[i];
    assert!(roof.iter().all(|i| tint(*i) == tint(roof[0])));
    assert_ne!(tint(roof[0]), tint(0), "the roof is not the ground");
    // The walls, one of which has no semantics, take the material of the building.
    assert_eq!(tint(4), [255; 4]);
    assert_eq!(tint(16), [255; 4]);
}

#[test]
fn a_document_of_several_lines_is_the_same_as_one_line() {
    let feature = common::CITY.lines().nth(1).unwrap();
    let line = feature.replace(
        r#""type":"CityJSONFeature","id":"a""#,
        r#""type":"CityJSON","version":"1.1","transform":{"scale":[0.001,0.001,0.001],"translate":[85000,446000,-2]}"#,
    );
    let spread = line.replace(',', ",\n  ");
    for text in [line.clone(), spread, format!("\u{feff}\r\n{line}\r\n")] {
        let scene = read(&text);
        assert_eq!(scene.len(), 2);
        assert_eq!(levels(&scene, "a-0"), levels(&read(common::CITY), "a-0"));
    }
    let old = line.replace("1.1", "1.0").replace(
        r#""transform":{"scale":[0.001,0.001,0.001],"translate":[85000,446000,-2]},"#,
        "",
    );
    let scene = read(&old.replace(r#""lod":"2""#, r#""lod":2.2"#));
    assert_eq!(levels(&scene, "a-0").len(), 2);
    let side = levels(&scene, "a-0")[1].positions[0][0].abs();
    assert_eq!(side, 5000.0, "untransformed vertices are metres");
}

#[test]
fn every_kind_of_solid_and_surface_is_read() {
    let cube = "[[[3,2,1,0]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]],[[4,5,6,7]]]";
    for (kind, boundaries) in [
        ("MultiSurface", cube.to_owned()),
        ("CompositeSurface", cube.to_owned()),
        ("Solid", format!("[{cube}]")),
        ("MultiSolid", format!("[[{cube}]]")),
        ("CompositeSolid", format!("[[{cube}],[]]")),
    ] {
        let scene = read(&common::bridge(&format!(
            r#"{{"type":"{kind}","lod":"1","boundaries":{boundaries}}}"#
        )));
        assert_eq!(volume(&levels(&scene, "b")[0]).round(), 1000.0, "{kind}");
        let (_, material) = scene.materials().next().unwrap();
        assert_eq!(material.double_sided, kind.ends_with("Surface"), "{kind}");
    }
}

#[test]
fn a_level_with_more_triangles_than_the_finest_is_no_proxy() {
    let swapped = common::CITY.replace(r#""lod":"1""#, r#""lod":"3""#);
    let scene = read(&swapped);
    let [fine, coarse] = levels(&scene, "a-0") else {
        panic!("two levels");
    };
    assert!(coarse.triangle_count() > fine.triangle_count());
    assert!(scene.meshes().all(|(_, mesh)| mesh.proxy.is_none()));
}

#[test]
fn a_group_is_no_place() {
    let grouped = common::CITY.replace(
        r#""CityObjects":{"a""#,
        r#""CityObjects":{"g":{"type":"CityObjectGroup","children":["a"]},"a""#,
    );
    let grouped = grouped.replace(
        r#""type":"Building","#,
        r#""type":"Building","parents":["g"],"#,
    );
    let scene = read(&grouped);
    assert_eq!(scene.len(), 2);
    assert_eq!(scene.roots().collect::<Vec<_>>(), [named(&scene, "a")]);
}

#[test]
fn children_alone_say_who_hangs_where() {
    let scene = read(&common::CITY.replace(r#""parents":["a"],"#, ""));
    assert_eq!(scene.parent(named(&scene, "a-0")), Some(named(&scene, "a")));
}

/// Real buildings: volumes equal those that their authors computed before they rounded the coordinates, at every
/// level.
#[test]
fn the_sample_of_delft_has_its_makers_volumes() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/data/delft-sample.city.jsonl"
    );
    let scene = load(Path::new(file), &LoadOptions::default()).unwrap();
    assert_eq!(scene.name(), "delft-sample.city");
    assert_eq!((scene.len(), scene.drawable_count()), (11, 6));
    for (id, volumes) in [
        ("0503100000019809", [3358.50, 3377.55, 3377.55]),
        ("0503100000019808", [3358.48, 3377.02, 3377.02]),
        ("0503100000032946", [71900.51, 70844.18, 73715.58]),
        ("0503100000030621", [12662.32, 12667.88, 12667.88]),
        ("0503100000019715", [3347.86, 3377.47, 3377.47]),
    ] {
        let building = named(&scene, &format!("NL.IMBAG.Pand.{id}"));
        let mut sums = [0.0; 3];
        for part in scene.children(building) {
            let levels = levels(&scene, scene.entity_name(part));
            for (sum, level) in sums.iter_mut().zip(levels) {
                *sum += volume(level);
                assert!(least_agreement(level) > 0.99, "{id}");
            }
        }
        for (sum, known) in sums.iter().zip(volumes) {
            assert!(
                (sum / known - 1.0).abs() < 3e-4,
                "{id}: {sums:?} and not {volumes:?}"
            );
        }
    }
}

proptest! {
    /// In every orientation of a polygon with a hole, its triangles cover it once and face the side from which it
    /// runs counter-clockwise.
    #[test]
    fn polygons_are_covered_once(
        radii in prop::collection::vec(2.0..10.0_f64, 3..40),
        hole in 0.1..0.9_f64,
        axis in prop::array::uniform3(-1.0..1.0_f64),
        angle in 0.0..6.3_f64,
    ) {
        let axis = DVec3::from(axis).try_normalize().unwrap_or(DVec3::X);
        let turn = glam::DQuat::from_axis_angle(axis, angle);
        let n = radii.len();
        let corner = |i: usize, scale: f64| {
            let turned = std::f64::consts::TAU * i as f64 / n as f64;
            let flat = DVec3::new(turned.cos(), turned.sin(), 0.0) * radii[i] * scale;
            (turn * flat * 1e6).round().to_array()
        };
        let vertices: Vec<_> = [1.0, hole].iter().flat_map(|s| (0..n).map(|i| corner(i, *s))).collect();
        let rings = [(0..n).collect::<Vec<_>>(), (n..2 * n).rev().collect()];
        let file = serde_json::json!({
            "type": "CityJSON", "version": "2.0",
            "transform": { "scale": [1e-6, 1e-6, 1e-6], "translate": [0, 0, 0] },
            "CityObjects": { "p": { "type": "Road", "geometry": [
                { "type": "MultiSurface", "lod": "1", "boundaries": [rings] } ] } },
            "vertices": vertices,
        });
        let scene = read(&file.to_string());
        let level = &levels(&scene, "p")[0];
        let wedge = |i: usize| radii[i] * radii[(i + 1) % n] * (std::f64::consts::TAU / n as f64).sin() / 2.0;
        let whole = (0..n).map(wedge).sum::<f64>();
        let expected = whole * (1.0 - hole * hole);
        prop_assert!((area(level) / expected - 1.0).abs() < 1e-4, "{} for {expected}", area(level));
        let [x, y, z] = (turn * DVec3::Z).to_array();
        for normal in &level.normals {
            prop_assert!(Vec3::from(*normal).as_dvec3().dot(DVec3::new(x, z, -y)) > 0.999);
        }
    }
}
