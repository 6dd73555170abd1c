//! CityJSON: of an object's surfaces, instances of templates, lines and points the finest level of detail is shown.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_formats::{
    LoadOptions, LoadedScene, LostPart, SceneFormat, load_slice, load_slice_with_attachments,
};
use antumbra_scene::{EntityKey, Scene, Topology};
use glam::{DVec3, Vec3};

fn read(text: &str) -> Scene {
    let options = LoadOptions::default();
    load_slice(SceneFormat::CityJson, text.as_bytes(), None, &options).unwrap()
}

fn named(scene: &Scene, name: &str) -> EntityKey {
    let mut found = scene.entities().filter(|e| scene.entity_name(*e) == name);
    let entity = found.next().unwrap();
    assert!(found.next().is_none(), "two entities \"{name}\"");
    entity
}

fn loaded(text: &str) -> LoadedScene {
    let options = LoadOptions::default();
    load_slice_with_attachments(SceneFormat::CityJson, text.as_bytes(), None, &options, &[])
        .unwrap()
}

/// The sequence with these members of its head.
fn with_head(text: &str, members: &str) -> String {
    text.replacen(
        r#""CityObjects":{}"#,
        &format!(r#""CityObjects":{{}},{members}"#),
        1,
    )
}

/// The shapes that are drawn, by their topology and number of elements, sorted by name of entity.
fn shown(scene: &Scene) -> Vec<(Topology, usize)> {
    let drawn = scene.drawables().map(|(entity, drawable)| {
        let level = &scene.mesh(drawable.mesh).unwrap().levels[0];
        let corners = match level.topology {
            Topology::Triangles => 3,
            Topology::Lines => 2,
            Topology::Points => 1,
        };
        let name = scene.entity_name(entity).to_owned();
        (name, (level.topology, level.indices.len() / corners))
    });
    let mut drawn: Vec<_> = drawn.collect();
    drawn.sort_by(|a, b| a.0.cmp(&b.0));
    drawn.into_iter().map(|(_, shape)| shape).collect()
}

/// Templates: a triangle of level 2, and one of level 3 without an area.
const TEMPLATES: &str = r#""geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]},{"type":"MultiSurface","lod":"3","boundaries":[[[0,1,1]]]}],"vertices-templates":[[0,0,0],[1,0,0],[0,1,0.5]]}"#;

fn surface(lod: &str) -> String {
    format!(r#"{{"type":"MultiSurface","lod":"{lod}","boundaries":[[[0,1,2,3]]]}}"#)
}

fn line(lod: &str) -> String {
    format!(r#"{{"type":"MultiLineString","lod":"{lod}","boundaries":[[0,1,2]]}}"#)
}

fn point(lod: &str) -> String {
    format!(r#"{{"type":"MultiPoint","lod":"{lod}","boundaries":[0]}}"#)
}

fn instance(template: u32, matrix: &str) -> String {
    format!(
        r#"{{"type":"GeometryInstance","template":{template},"boundaries":[0],"transformationMatrix":[{matrix}]}}"#
    )
}

const IDENTITY: &str = "1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1";

#[test]
fn the_finest_of_surfaces_instances_lines_and_points_is_shown() {
    let (area, lines, points) = (
        (Topology::Triangles, 2),
        (Topology::Lines, 2),
        (Topology::Points, 1),
    );
    let placed = (Topology::Triangles, 1);
    for (geometries, wanted) in [
        (vec![surface("1"), line("2"), point("1")], vec![lines]),
        (vec![line("1"), surface("2"), point("1")], vec![area]),
        (vec![line("1"), surface("1"), point("2")], vec![points]),
        (vec![surface("2"), line("2"), point("1")], vec![area, lines]),
        (
            vec![surface("1"), instance(0, IDENTITY), line("1")],
            vec![placed],
        ),
        (
            vec![surface("2"), instance(0, IDENTITY)],
            vec![area, placed],
        ),
        (vec![surface("3"), instance(0, IDENTITY)], vec![area]),
        (vec![instance(0, IDENTITY), line("2.1")], vec![lines]),
    ] {
        let text = with_head(&common::bridge(&geometries.join(",")), TEMPLATES);
        assert_eq!(shown(&read(&text)), wanted, "{geometries:?}");
    }
}

#[test]
fn what_cannot_be_drawn_hides_nothing() {
    let flat = r#"{"type":"MultiSurface","lod":"3","boundaries":[[[0,1,1]]]}"#;
    for fine in [
        instance(0, "1"),
        instance(7, IDENTITY),
        instance(1, IDENTITY),
        flat.to_owned(),
        r#"{"type":"MultiLineString","lod":"3","boundaries":[[0]]}"#.to_owned(),
    ] {
        for (coarse, wanted) in [
            (surface("1"), (Topology::Triangles, 2)),
            (line("1"), (Topology::Lines, 2)),
        ] {
            let text = common::bridge(&format!("{fine},{coarse}"));
            let scene = read(&with_head(&text, TEMPLATES));
            assert_eq!(shown(&scene), [wanted], "{fine} before {coarse}");
        }
    }
}

#[test]
fn surfaces_of_templates_have_the_tints_of_their_semantics() {
    let semantics = r#""semantics":{"surfaces":[{"type":"RoofSurface"},{"type":"WallSurface"}],"values":[0,1]}"#;
    let boundaries = r#""boundaries":[[[0,1,2]],[[0,2,1]]]"#;
    let templates = format!(
        r#""geometry-templates":{{"templates":[{{"type":"MultiSurface","lod":"2",{boundaries},{semantics}}},{{"type":"MultiSurface","lod":"2",{boundaries}}}],"vertices-templates":[[0,0,0],[1,0,0],[0,1,0.5]]}}"#
    );
    let own = format!(
        r#"{{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]],[[0,2,3]]],{semantics}}}"#
    );
    let geometries = [own, instance(0, IDENTITY), instance(1, IDENTITY)].join(",");
    let scene = read(&with_head(&common::bridge(&geometries), &templates));
    let colours = |mesh: &str| {
        let (_, mesh) = scene.meshes().find(|(_, m)| m.name == mesh).unwrap();
        mesh.levels[0].colours.clone()
    };
    let [roof, .., wall] = *colours("template 0") else {
        panic!("no tints")
    };
    assert_ne!(roof, wall);
    assert_eq!(colours("template 0"), colours("b"));
    assert!(colours("template 1").is_empty());
}

#[test]
fn materials_textures_and_faces_of_templates_that_are_not_shown_are_counted() {
    let appearance =
        r#""appearance":{"materials":[{"name":"a"},{"name":"b"}],"textures":[{"type":"PNG"}]}"#;
    let text = with_head(
        &common::bridge(&surface("1")),
        &format!("{TEMPLATES},{appearance}"),
    );
    let losses = loaded(&text).left_out.to_string();
    assert_eq!(
        losses,
        "1 face (without an area), 2 materials (materials of CityJSON), 1 image (textures of CityJSON)"
    );
}

#[test]
fn what_is_no_surface_is_left_out() {
    for geometry in [
        r#"{"type":"MultiTorus","lod":"1","boundaries":[0,1]}"#,
        r#"{"type":"GeometryInstance","template":0,"boundaries":[0],"transformationMatrix":[1]}"#,
    ] {
        let options = LoadOptions::default();
        let text = common::bridge(geometry);
        let format = SceneFormat::CityJson;
        let loaded = load_slice_with_attachments(format, text.as_bytes(), None, &options, &[]);
        let loaded = loaded.unwrap();
        let scene = &loaded.scene;
        assert_eq!((scene.len(), scene.drawable_count()), (1, 0), "{geometry}");
        let [loss] = loaded.left_out.losses() else {
            panic!("{geometry}: {}", loaded.left_out)
        };
        assert_eq!(
            (loss.part, loss.count),
            (LostPart::Geometry, 1),
            "{geometry}"
        );
    }
    let footprint = r#"{"type":"MultiSurface","lod":"0","boundaries":[[[0,1,2,3]]]}"#;
    let scene = read(&common::bridge(footprint));
    assert_eq!(scene.triangle_count(), 2, "there is nothing better");
}

#[test]
fn lines_and_points_are_entities_below_their_object() {
    for (geometry, topology, indices) in [
        (
            r#"{"type":"MultiPoint","lod":"1","boundaries":[0,1]}"#,
            Topology::Points,
            vec![0, 1],
        ),
        (
            r#"{"type":"MultiLineString","lod":"1","boundaries":[[0,1,2],[2,3]]}"#,
            Topology::Lines,
            vec![0, 1, 1, 2, 3, 4],
        ),
    ] {
        let scene = read(&common::bridge(geometry));
        let (entity, drawable) = scene.drawables().next().unwrap();
        assert_eq!(scene.parent(entity), Some(named(&scene, "b")));
        let shown = &scene.mesh(drawable.mesh).unwrap().levels[0];
        assert_eq!((shown.topology, &shown.indices), (topology, &indices));
        let world = scene.world(entity).unwrap();
        let corner = world.transform_point3(Vec3::from(shown.positions[1]).as_dvec3());
        assert!(
            corner.abs_diff_eq(DVec3::new(85_010.0, -2.0, -446_000.0), 1e-4),
            "{corner}"
        );
    }
}

#[test]
fn templates_are_placed_turned_and_scaled_as_often_as_they_are_named() {
    // A triangle of a metre to the east and to the north. It is turned by a quarter, east to north, and made thrice as large.
    let (head, feature) = common::CITY.split_once('\n').unwrap();
    let head = head.replace(
        r#""CityObjects":{}"#,
        r#""CityObjects":{},"geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}],"vertices-templates":[[0,0,0],[1,0,0],[0,1,0.5]]}"#,
    );
    let vertices = &feature[feature.find(r#""vertices""#).unwrap()..];
    let instance = |at: u32, matrix: &str| {
        format!(
            r#"{{"type":"SolitaryVegetationObject","geometry":[{{"type":"GeometryInstance","template":0,"boundaries":[{at}],"transformationMatrix":[{matrix}]}}]}}"#
        )
    };
    let text = format!(
        "{head}\n{{\"type\":\"CityJSONFeature\",\"CityObjects\":{{\"t\":{},\"u\":{}}},{vertices}",
        instance(1, "0,-3,0,0, 3,0,0,0, 0,0,3,0, 0,0,0,1"),
        instance(2, "1,0,0,7, 0,1,0,8, 0,0,1,9, 0,0,0,1"),
    );
    let scene = read(&text);
    assert_eq!((scene.mesh_count(), scene.drawable_count()), (1, 2));
    let corners = |of: &str| -> Vec<DVec3> {
        let below = |e: &EntityKey| scene.parent(*e) == Some(named(&scene, of));
        let (entity, drawable) = scene.drawables().find(|(e, _)| below(e)).unwrap();
        let world = scene.world(entity).unwrap();
        let positions = &scene.mesh(drawable.mesh).unwrap().levels[0].positions;
        let place = |p: &[f32; 3]| world.transform_point3(Vec3::from(*p).as_dvec3());
        positions.iter().map(place).collect()
    };
    let close = |found: Vec<DVec3>, wanted: [[f64; 3]; 3]| {
        for (found, wanted) in found.iter().zip(wanted) {
            assert!(
                found.abs_diff_eq(DVec3::from(wanted), 1e-4),
                "{found} for {wanted:?}"
            );
        }
    };
    // East, up, south of the world.
    let [x, y, z] = [85_010.0, -2.0, -446_000.0];
    close(
        corners("t"),
        [[x, y, z], [x, y, z - 3.0], [x - 3.0, y + 1.5, z]],
    );
    let [x, y, z] = [85_017.0, 7.0, -446_018.0];
    close(
        corners("u"),
        [[x, y, z], [x + 1.0, y, z], [x, y + 0.5, z - 1.0]],
    );
}
