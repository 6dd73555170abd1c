//! glTF: each feature in a small file, checked down to the numbers.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_formats::{LoadOptions, SceneFormat, load_slice};
use antumbra_scene::{
    AlphaMode, EntityKey, Geometry, Light, PlacedLight, Projection, Scene, Topology, Wrap,
};
use base64::Engine;
use common::{floats, primitive, scene, shorts};
use glam::DVec3;

fn read(file: &[u8]) -> Scene {
    let mut scene = load_slice(SceneFormat::Gltf, file, None, &LoadOptions::default()).unwrap();
    scene.update();
    scene
}

fn named(scene: &Scene, name: &str) -> EntityKey {
    scene
        .entities()
        .find(|e| scene.entity_name(*e) == name)
        .unwrap()
}

fn only(scene: &Scene) -> Geometry {
    let (_, mesh) = scene.meshes().next().unwrap();
    mesh.levels[0].clone()
}

#[test]
fn nodes_become_a_tree_of_entities_that_share_meshes() {
    let scene = read(&scene(
        r#"{"name":"above","translation":[1,2,3],"children":[1]},
           {"name":"below","mesh":0,"rotation":[0,0,0.70710678,0.70710678],"scale":[2,2,2]},
           {"name":"matrix","mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 7,8,9,1]}"#,
        "",
    ));
    assert_eq!(scene.len(), 3);
    assert_eq!(scene.mesh_count(), 1, "one mesh, placed twice");
    assert_eq!(scene.triangle_count(), 4);
    let below = named(&scene, "below");
    assert_eq!(scene.parent(below), Some(named(&scene, "above")));
    let corner = scene.world(below).unwrap().transform_point3(DVec3::X);
    assert!(
        corner.abs_diff_eq(DVec3::new(1.0, 4.0, 3.0), 1e-6),
        "{corner}"
    );
    let matrix = named(&scene, "matrix");
    assert_eq!(
        scene.world(matrix).unwrap().translation,
        DVec3::new(7.0, 8.0, 9.0)
    );
    assert!(scene.bounds().unwrap().contains(DVec3::new(8.0, 9.0, 9.0)));
}

#[test]
fn only_the_chosen_scene_is_read() {
    let scene = read(&scene(
        r#"{"name":"shown","mesh":0},{"name":"hidden","mesh":0}"#,
        r#","scene":1,"scenes":[{"nodes":[1]},{"nodes":[0]}]"#,
    ));
    assert_eq!(scene.len(), 1);
    named(&scene, "shown");
}

#[test]
fn every_mode_becomes_a_list() {
    let corners = floats(&[0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.]);
    let modes = [
        (0, Topology::Points, vec![0, 1, 2, 3]),
        (1, Topology::Lines, vec![0, 1, 2, 3]),
        (2, Topology::Lines, vec![0, 1, 1, 2, 2, 3, 3, 0]),
        (3, Topology::Lines, vec![0, 1, 1, 2, 2, 3]),
        (5, Topology::Triangles, vec![0, 1, 2, 1, 3, 2]),
        (6, Topology::Triangles, vec![1, 2, 0, 2, 3, 0]),
    ];
    for (mode, topology, expected) in modes {
        let file = primitive(
            &format!(r#"{{"attributes":{{"POSITION":0}},"mode":{mode}}}"#),
            r#"{"buffer":0,"byteLength":48}"#,
            r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}"#,
            &corners,
        );
        let found = only(&read(&file));
        assert_eq!(
            (found.topology, found.indices),
            (topology, expected),
            "mode {mode}"
        );
    }
}

#[test]
fn only_the_vertices_that_are_used_are_kept() {
    let mut binary = floats(&[
        9., 9., 9., 0., 0., 0., 9., 9., 9., 1., 0., 0., 0., 1., 0., 9., 9., 9.,
    ]);
    binary.extend([1, 3, 4, 0]);
    let file = primitive(
        r#"{"attributes":{"POSITION":0},"indices":1}"#,
        r#"{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":3}"#,
        r#"{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"},{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}"#,
        &binary,
    );
    let found = only(&read(&file));
    assert_eq!(
        found.positions,
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    );
    assert_eq!(found.indices, [0, 1, 2]);
}

#[test]
fn quantised_strided_and_sparse_accessors_mean_their_numbers() {
    // Four shorts per vertex, the last one padding.
    let mut binary = shorts(&[0, 0, 0, 0, 32767, 0, 0, 0, 0, 0x8000, 0, 0]);
    // Vertex 2 is replaced; the replacement has no padding.
    binary.extend([2, 0]);
    binary.extend(shorts(&[0, 0x8001, 16384]));
    // Colours: bytes 255, 128, 0 for each.
    binary.extend([255, 128, 0, 255, 128, 0, 255, 128, 0, 0]);
    let file = primitive(
        r#"{"attributes":{"POSITION":0,"COLOR_0":1}}"#,
        r#"{"buffer":0,"byteLength":24,"byteStride":8},{"buffer":0,"byteOffset":24,"byteLength":1},{"buffer":0,"byteOffset":26,"byteLength":6},{"buffer":0,"byteOffset":32,"byteLength":9}"#,
        r#"{"bufferView":0,"componentType":5122,"normalized":true,"count":3,"type":"VEC3",
            "sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":2}}},
           {"bufferView":3,"componentType":5121,"normalized":true,"count":3,"type":"VEC3"}"#,
        &binary,
    );
    let found = only(&read(&file));
    assert_eq!(found.positions[1], [1.0, 0.0, 0.0]);
    assert_eq!(found.positions[2], [0.0, -1.0, 16384.0 / 32767.0]);
    assert_eq!(found.colours, [[255, 128, 0, 255]; 3]);
}

#[test]
fn morph_targets_are_applied_at_their_default_weights() {
    let mut binary = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
    binary.extend(floats(&[0., 0., 4., 0., 0., 0., 0., 0., 8.]));
    let json =
        r#"{"attributes":{"POSITION":0},"targets":[{"POSITION":1}]}],"weights":[0.25],"extras":[0"#;
    let file = primitive(
        json,
        r#"{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36}"#,
        r#"{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}"#,
        &binary,
    );
    let found = only(&read(&file));
    assert_eq!(
        found.positions,
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 2.0]]
    );
}

#[test]
fn a_skinned_mesh_stands_where_its_joints_are() {
    let mut binary = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
    binary.extend([0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0]);
    binary.extend(floats(&[1., 0., 0., 0., 1., 0., 0., 0., 0.5, 0.5, 0., 0.]));
    let json = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":96}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},{"buffer":0,"byteOffset":48,"byteLength":48}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"},{"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],
"skins":[{"joints":[1,2]}],
"nodes":[{"name":"skinned","mesh":0,"skin":0,"translation":[100,0,0]},{"translation":[0,0,10],"children":[2]},{"translation":[0,0,10]}]}"#;
    let scene = read(&common::glb(json, &binary));
    let world = scene.world(named(&scene, "skinned")).unwrap();
    let stand = only(&scene).positions.into_iter().map(|p| {
        let position = glam::Vec3::from(p).as_dvec3();
        world.transform_point3(position)
    });
    let expected = [
        DVec3::new(0., 0., 10.),
        DVec3::new(1., 0., 20.),
        DVec3::new(0., 1., 15.),
    ];
    assert_eq!(
        stand.collect::<Vec<_>>(),
        expected,
        "the node's own transform does not count"
    );
}

#[test]
fn levels_of_detail_are_the_mesh_s_levels_and_its_proxy() {
    let scene = read(&scene(
        r#"{"name":"near","mesh":0,"extensions":{"MSFT_lod":{"ids":[1,2]}}},{"mesh":0},{"mesh":0,"translation":[0,0,5]}"#,
        r#","extensionsRequired":["MSFT_lod"]"#,
    ));
    assert_eq!(scene.len(), 1, "the nodes of the levels are no entities");
    let (_, mesh) = scene.meshes().next().unwrap();
    assert_eq!(mesh.levels.len(), 2);
    assert_eq!(mesh.levels[0], mesh.levels[1]);
    let proxy = mesh.proxy.as_ref().unwrap();
    assert!(
        proxy.positions.iter().all(|p| p[2] == 5.0),
        "it stands elsewhere"
    );
    assert_eq!(scene.bounds().unwrap().max.z.round(), 5.0);
}

#[test]
fn instances_are_entities() {
    let scene = read(&scene(
        r#"{"name":"row","mesh":0,"translation":[0,0,1],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}}"#,
        r#","extensionsRequired":["EXT_mesh_gpu_instancing"]"#,
    ));
    let row = named(&scene, "row");
    assert_eq!(scene.drawable(row), None);
    let places: Vec<_> = scene
        .children(row)
        .map(|e| scene.world(e).unwrap().translation)
        .collect();
    assert_eq!(
        places,
        [
            DVec3::Z,
            DVec3::new(1., 0., 1.),
            DVec3::new(0., 1., 1.),
            DVec3::new(1., 1., 1.)
        ]
    );
    assert_eq!(scene.mesh_count(), 1);
}

#[test]
fn extras_say_what_is_not_tested() {
    let triangle = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
    let part = r#"{"attributes":{"POSITION":0}}"#;
    let json = |extras: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":36}}],"bufferViews":[{{"buffer":0,"byteLength":36}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],"meshes":[{{"primitives":[{part},{part}]}}],
"nodes":[{{"mesh":0,"extras":{extras},"children":[1]}},{{"mesh":0}},
{{"mesh":0,"extras":{extras},"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":0}}}}}}}}]}}"#
        )
    };
    let untested = |extras: &str| {
        let scene = read(&common::glb(&json(extras), &triangle));
        assert_eq!(scene.len(), 6 + 1 + 3 * 3);
        let drawn = |e: &EntityKey| scene.drawable(*e).is_some();
        let all = scene.entities().filter(|e| !scene.is_tested(*e));
        all.filter(drawn).count()
    };
    // Both primitives of the first node and of the three instances; child nodes keep their own settings.
    assert_eq!(untested(r#"{"tested":false}"#), 2 + 6);
    assert_eq!(untested(r#" { "by":"hand", "tested" : false } "#), 2 + 6);
    for other in [
        r#"{"tested":true}"#,
        r#"{"tested":0}"#,
        r#"{"tested":null}"#,
        r#"{"Tested":false}"#,
        r#"{"in":{"tested":false}}"#,
        "[false]",
        "false",
        r#""tested""#,
        "null",
        "{}",
    ] {
        assert_eq!(untested(other), 0, "{other}");
    }
}

#[test]
fn what_says_nothing_of_metal_is_rough_metal() {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},{square},
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}},{{"attributes":{{"POSITION":0}},"indices":1,"material":1}},{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
"nodes":[{{"mesh":0}}],
"materials":[{{"name":"silent"}},{{"name":"painted","pbrMetallicRoughness":{{"metallicRoughnessTexture":{{"index":0}}}}}}],
"textures":[{{"source":0}}],"images":[{{"uri":"none.png"}}]}}"#,
        square = common::SQUARE
    );
    let scene = read(&common::glb(&json, &common::square()));
    let shine = |name: &str| {
        let mut materials = scene.materials();
        let (_, found) = materials.find(|(_, m)| m.name == name).unwrap();
        [found.metallic, found.roughness]
    };
    assert_eq!(shine("silent"), [1.0, 1.0]);
    assert_eq!(shine("painted"), [0.0, 1.0], "its image is not read");
    assert_eq!(shine(""), [0.0, 1.0], "no material at all");
}

#[test]
fn materials_say_how_a_surface_looks() {
    let png = base64::engine::general_purpose::STANDARD.encode(common::PNG);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},{square},
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}},{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
"nodes":[{{"name":"both","mesh":0}}],
"materials":[{{"name":"leaf","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,"extensions":{{"KHR_materials_unlit":{{}}}},
"pbrMetallicRoughness":{{"metallicFactor":0.25,"roughnessFactor":0.5,"baseColorFactor":[0.5,0.25,0.125,1],"baseColorTexture":{{"index":0,"extensions":{{"KHR_texture_transform":{{"offset":[0.5,0.25],"scale":[2,4]}}}}}}}}}}],
"textures":[{{"source":0,"sampler":0}}],"samplers":[{{"wrapS":33071,"wrapT":33648}}],
"images":[{{"uri":"data:image/png;base64,{png}"}}]}}"#,
        square = common::SQUARE
    );
    let scene = read(&common::glb(&json, &common::square()));
    assert_eq!(
        scene.children(named(&scene, "both")).count(),
        2,
        "an entity a primitive"
    );
    let (_, leaf) = scene.materials().find(|(_, m)| m.name == "leaf").unwrap();
    assert_eq!(leaf.base_colour, [0.5, 0.25, 0.125, 1.0]);
    assert_eq!([leaf.metallic, leaf.roughness], [0.25, 0.5]);
    assert_eq!(leaf.alpha, AlphaMode::Mask { cutoff: 0.25 });
    assert!(leaf.double_sided && leaf.unlit);
    assert_eq!(leaf.uv_transform, [[2.0, 0.0, 0.5], [0.0, 4.0, 0.25]]);
    let image = scene.image(leaf.base_colour_image.unwrap()).unwrap();
    assert_eq!((image.width, image.height), (2, 1));
    assert_eq!(image.rgba, [255, 0, 0, 255, 0, 255, 0, 128]);
    assert_eq!(
        (image.sampler.wrap_u, image.sampler.wrap_v),
        (Wrap::Clamp, Wrap::Mirror)
    );
    assert_eq!(
        scene.materials().count(),
        2,
        "the other primitive has the default one"
    );
}

#[test]
fn cameras_and_lights_stand_at_their_nodes() {
    let scene = read(&scene(
        r#"{"camera":0,"translation":[0,0,5]},{"camera":1},{"translation":[0,3,0],"extensions":{"KHR_lights_punctual":{"light":0}}}"#,
        r#","cameras":[{"type":"perspective","perspective":{"yfov":1.0,"znear":0.5}},{"type":"orthographic","orthographic":{"xmag":2,"ymag":3,"znear":0,"zfar":9}}],
           "extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":7,"color":[1,0.5,0],"range":20,"spot":{"outerConeAngle":0.5}}]}}"#,
    ));
    let cameras: Vec<_> = scene.cameras().map(|(_, camera)| camera).collect();
    assert_eq!(cameras[0].position, DVec3::new(0.0, 0.0, 5.0));
    assert_eq!(
        cameras[0].projection,
        Projection::Perspective {
            fov_y: 1.0,
            near: 0.5
        }
    );
    assert_eq!(
        cameras[1].projection,
        Projection::Orthographic {
            height: 6.0,
            near: 0.0,
            far: 9.0
        }
    );
    let PlacedLight { light, world, .. } = scene.lights().next().unwrap();
    assert_eq!(world.translation, DVec3::new(0.0, 3.0, 0.0));
    let expected = Light::Spot {
        colour: [1.0, 0.5, 0.0],
        intensity: 7.0,
        range: Some(20.0),
        inner: 0.0,
        outer: 0.5,
    };
    assert_eq!(light, expected);
}

#[test]
fn a_hundred_thousand_nodes_deep_is_no_deeper_than_the_stack() {
    let count = 100_000;
    let nodes: Vec<String> = (0..count)
        .map(|i| match i + 1 {
            next if next < count => format!(r#"{{"translation":[1,0,0],"children":[{next}]}}"#),
            _ => r#"{"mesh":0}"#.to_owned(),
        })
        .collect();
    let scene = read(&scene(&nodes.join(","), ""));
    assert_eq!(scene.len(), count);
    assert_eq!(scene.bounds().unwrap().max.x.round(), count as f64);
}

#[test]
fn boxes_come_from_positions_whatever_the_file_says() {
    let inside_out = r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[9,9,9],"max":[-9,-9,-9]},
        {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}"#;
    let views = r#"{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}"#;
    let square = common::square();
    let triangles = r#"{"attributes":{"POSITION":0},"indices":1}"#;
    let scene = read(&primitive(triangles, views, inside_out, &square));
    let bounds = scene.bounds().unwrap();
    assert!(bounds.min.abs_diff_eq(DVec3::ZERO, 1e-9), "{bounds:?}");
    assert!(bounds.max.abs_diff_eq(DVec3::new(1.0, 1.0, 0.0), 1e-9));
}
