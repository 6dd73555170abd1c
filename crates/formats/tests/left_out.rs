//! What a load leaves out is said: by kind and reason, counted, with the first by name; and a strict load refuses it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_formats::{
    LoadOptions, LoadProblem, LoadedScene, LostPart, SceneFormat, load_slice_with_attachments,
    load_with_attachments,
};
use common::{floats, primitive};

const SQUARE_MESH: &str = r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],"nodes":[{"mesh":0}]"#;

/// A glTF of the square with these further members.
fn gltf(more: &str) -> Vec<u8> {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},{},{SQUARE_MESH},{more}}}"#,
        common::SQUARE
    );
    common::glb(&json, &common::square())
}

fn loaded(format: SceneFormat, bytes: &[u8]) -> LoadedScene {
    load_slice_with_attachments(format, bytes, None, &LoadOptions::default(), &[]).unwrap()
}

fn lost(format: SceneFormat, bytes: &[u8]) -> String {
    loaded(format, bytes).left_out.to_string()
}

#[test]
fn attributes_of_an_obj_that_are_left_out_have_the_line_of_the_first() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n\
        f 1/1 2/1 3/1\nf 1/1 2/1 3\nf 1 2 3\nl 1/1 2/1\nl 1/7 2/1 3/7\np 1//2\n";
    let loaded = loaded(SceneFormat::Obj, obj.as_bytes());
    let losses: Vec<_> = (loaded.left_out.losses().iter())
        .map(|loss| (loss.part, loss.count, loss.examples.join(", ")))
        .collect();
    let expected = [
        (LostPart::Attribute, 3, "line 9, line 10".to_owned()),
        (LostPart::Attribute, 4, "line 6".to_owned()),
    ];
    assert_eq!(losses, expected);
}

#[test]
fn images_that_cannot_be_had_cost_the_image_alone() {
    let image = |image: &str, extensions: &str| {
        gltf(&format!(
            r#""materials":[{{"pbrMetallicRoughness":{{"baseColorFactor":[1,0,0,1],"baseColorTexture":{{"index":0}}}}}}],"textures":[{{{extensions}}}],"images":[{image}]"#
        ))
    };
    let dds = r#""extensions":{"MSFT_texture_dds":{"source":0}}"#;
    let files = [
        (
            image(r#"{"uri":"gone.png"}"#, r#""source":0"#),
            "broken reference",
        ),
        (
            image(
                r#"{"uri":"data:image/png;base64,iVBORw0K"}"#,
                r#""source":0"#,
            ),
            "unknown format",
        ),
        (image(r#"{"uri":"data:;base64,RERTIHwAAAA="}"#, dds), "DDS"),
        (
            image(r#"{"bufferView":9}"#, r#""source":0"#),
            "its bytes are not there",
        ),
        (
            image(r#"{}"#, r#""source":0"#),
            "neither a uri nor a buffer view",
        ),
        (image(r#"{}"#, r#""source":7"#), "no such image"),
        (image(r#"{}"#, ""), "a texture without an image"),
    ];
    for (file, reason) in files {
        let loaded = loaded(SceneFormat::Gltf, &file);
        assert_eq!(loaded.scene.triangle_count(), 2);
        let (_, material) = loaded.scene.materials().next().unwrap();
        assert_eq!(material.base_colour, [1.0, 0.0, 0.0, 1.0]);
        let [loss] = loaded.left_out.losses() else {
            panic!("{reason}: {}", loaded.left_out)
        };
        assert_eq!((loss.part, loss.count), (LostPart::Image, 1));
        assert!(loss.reason.contains(reason), "{reason}: {loss}");
        assert_eq!(loss.examples.len(), 1);
    }
}

#[test]
fn a_missing_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gltf");
    let json = r#"{"asset":{"version":"2.0"},"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],"images":[{"uri":"not there.png"}],
"buffers":[{"byteLength":36,"uri":"a.bin"}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"nodes":[{"mesh":0}]}"#;
    std::fs::write(
        folder.path().join("a.bin"),
        floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]),
    )
    .unwrap();
    std::fs::write(&path, json).unwrap();
    let loaded = load_with_attachments(&path, &LoadOptions::default(), &[]).unwrap();
    assert_eq!(loaded.left_out.to_string(), "1 image (missing)");
    assert!(loaded.left_out.losses()[0].examples[0].contains("not there.png"));
    let strict = LoadOptions {
        strict: true,
        ..LoadOptions::default()
    };
    let error = load_with_attachments(&path, &strict, &[]).unwrap_err();
    assert!(
        matches!(*error.problem, LoadProblem::LeftOut { .. }),
        "{error}"
    );
    let text = error.to_string();
    assert!(text.contains("1 image (missing)"), "{text}");
    assert_eq!(text.matches("a.gltf").count(), 1, "{text}");
    let skip = LoadOptions {
        skip_images: true,
        ..strict
    };
    assert!(
        load_with_attachments(&path, &skip, &[]).is_ok(),
        "images that are not asked for are not lost"
    );
}

#[test]
fn animations_extensions_and_shading_are_counted() {
    let file = gltf(
        r#""materials":[{"normalTexture":{"index":0},"extensions":{"KHR_materials_clearcoat":{}}}],"animations":[{"name":"turn","channels":[],"samplers":[]},{"channels":[],"samplers":[]}],
"extensionsUsed":["KHR_materials_clearcoat","EXT_unheard_of"],"extensionsRequired":["KHR_materials_clearcoat"]"#,
    );
    let loaded = loaded(SceneFormat::Gltf, &file);
    assert_eq!(
        loaded.left_out.to_string(),
        "1 element (the extension EXT_unheard_of), 2 animations (no channel of it can be played), 1 shading detail (KHR_materials_clearcoat), 1 shading detail (normal maps)"
    );
    assert_eq!(
        loaded.left_out.losses()[1].examples,
        ["animation 0 \"turn\"", "animation 1"]
    );
    let shading = gltf(r#""materials":[{"normalTexture":{"index":0}}]"#);
    let strict = LoadOptions {
        strict: true,
        ..LoadOptions::default()
    };
    assert!(load_slice_with_attachments(SceneFormat::Gltf, &shading, None, &strict, &[]).is_ok());
}

#[test]
fn what_is_scaled_to_nothing_is_said() {
    let file = common::scene(r#"{"scale":[0,0,0],"children":[1]},{"mesh":0}"#, "");
    assert_eq!(
        lost(SceneFormat::Gltf, &file),
        "1 entity (scaled to nothing)"
    );
}

#[test]
fn data_that_an_unknown_extension_may_hold_is_an_error() {
    let empty = |extensions: &str| {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},{extensions}"accessors":[{{"componentType":5126,"count":3,"type":"VEC3"}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"nodes":[{{"mesh":0}}]}}"#
        );
        load_slice_with_attachments(
            SceneFormat::Gltf,
            json.as_bytes(),
            None,
            &LoadOptions::default(),
            &[],
        )
    };
    for name in ["KHR_draco_mesh_compression", "EXT_unheard_of"] {
        let error = empty(&format!(r#""extensionsUsed":["{name}"],"#)).unwrap_err();
        assert!(
            matches!(*error.problem, LoadProblem::MissingData { .. }),
            "{error}"
        );
        let text = error.to_string();
        assert!(
            text.contains(name) && text.contains("extensionsRequired"),
            "{text}"
        );
    }
    // Zeros, as the format says.
    assert!(empty("").is_ok());
    assert!(empty(r#""extensionsUsed":["KHR_materials_clearcoat"],"#).is_ok());
}

#[test]
fn normals_and_coordinates_that_are_not_finite_cost_no_shape() {
    let mut binary = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
    binary.extend(floats(&[0., 0., 1., f32::NAN, 0., 1., 0., 0., 1.]));
    binary.extend(floats(&[0., 0., 1., f32::INFINITY, 0., 1.]));
    let view = |offset: usize, length: usize| {
        format!(r#"{{"buffer":0,"byteOffset":{offset},"byteLength":{length}}}"#)
    };
    let accessor = |view: usize, kind: &str| {
        format!(r#"{{"bufferView":{view},"componentType":5126,"count":3,"type":"{kind}"}}"#)
    };
    let file = primitive(
        r#"{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}}"#,
        &[view(0, 36), view(36, 36), view(72, 24)].join(","),
        &[
            accessor(0, "VEC3"),
            accessor(1, "VEC3"),
            accessor(2, "VEC2"),
        ]
        .join(","),
        &binary,
    );
    let loaded = loaded(SceneFormat::Gltf, &file);
    let (_, mesh) = loaded.scene.meshes().next().unwrap();
    assert_eq!(mesh.levels[0].normals, [[0.0, 0.0, 1.0]; 3]);
    assert_eq!(mesh.levels[0].uvs[1], [1.0, 0.0]);
    let words = loaded.left_out.to_string();
    assert!(
        words.contains("normals") && words.contains("texture coordinates"),
        "{words}"
    );
}

#[test]
fn cameras_lights_and_levels_without_what_they_need_are_said() {
    let file = common::scene(
        r#"{"mesh":0,"extensions":{"MSFT_lod":{"ids":[1]}}},{"name":"empty"}"#,
        r#","scenes":[{"nodes":[0]}],"extensionsUsed":["MSFT_lod"]"#,
    );
    assert_eq!(
        lost(SceneFormat::Gltf, &file),
        "1 level of detail (a node that is not there or has no mesh)"
    );
    let file = common::scene(
        r#"{"mesh":0,"camera":0}"#,
        r#","cameras":[{"type":"perspective"}]"#,
    );
    assert_eq!(
        lost(SceneFormat::Gltf, &file),
        "1 element (a camera without a projection)"
    );
}

#[test]
fn a_skin_of_several_primitives_is_counted_once() {
    let primitive = r#"{"attributes":{"POSITION":0},"indices":1}"#;
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},{},"meshes":[{{"primitives":[{primitive},{primitive}]}}],"nodes":[{{"mesh":0,"skin":0,"scale":[1,0,1]}},{{}}],"skins":[{{"joints":[1]}}]}}"#,
        common::SQUARE
    );
    let file = common::glb(&json, &common::square());
    let words = lost(SceneFormat::Gltf, &file);
    assert!(words.contains("1 skin ("), "{words}");
}

#[test]
fn an_emission_beyond_all_numbers_is_said_and_stays_bright() {
    let emission = |factor: f32| {
        gltf(&format!(
            r#""materials":[{{"emissiveFactor":[{factor},1,0],"extensions":{{"KHR_materials_emissive_strength":{{"emissiveStrength":1e38}}}}}}],"extensionsUsed":["KHR_materials_emissive_strength"]"#
        ))
    };
    let loaded = loaded(SceneFormat::Gltf, &emission(10.0));
    let (_, material) = loaded.scene.materials().next().unwrap();
    assert_eq!(material.emission, [f32::MAX, 1e38, 0.0]);
    assert_eq!(
        loaded.left_out.to_string(),
        "1 shading detail (an emission that is not finite)"
    );
    assert_eq!(lost(SceneFormat::Gltf, &emission(1.0)), "");
}

#[test]
fn lists_and_colours_of_the_faces_of_a_ply_are_said() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 0 1 255 0 0\n";
    assert_eq!(
        lost(SceneFormat::Ply, ply.as_bytes()),
        "1 vertex attribute (colours of faces), 1 vertex attribute (the list \"texcoord\" of faces)"
    );
    assert_eq!(lost(SceneFormat::Ply, &common::ply_binary()), "");
}

#[test]
fn materials_of_an_obj_without_a_library_are_said() {
    let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    assert_eq!(
        lost(SceneFormat::Obj, obj),
        "1 material (no library has it)"
    );
}

#[test]
fn a_scene_without_anything_to_draw_says_why() {
    let nothing = |format: SceneFormat, bytes: &[u8]| {
        let problem = loaded(format, bytes).drawable().unwrap_err();
        assert!(matches!(problem, LoadProblem::NothingToDraw { .. }));
        problem.to_string()
    };
    let curves = b"v 0 0 0\nv 1 0 0\ncurv 0 1 1 2\n";
    let text = nothing(SceneFormat::Obj, curves);
    assert!(text.contains("free-form curves"), "{text}");
    let text = nothing(SceneFormat::Stl, &common::stl_binary(b"", 0));
    assert!(text.contains("export it again"), "{text}");
    assert!(
        loaded(SceneFormat::Obj, b"v 0 0 0\nv 1 0 0\nl 1 2\n")
            .drawable()
            .is_ok()
    );
}

#[test]
fn what_a_file_says_of_its_losses_is_short_and_clean() {
    let extensions: Vec<String> = (0..1000)
        .map(|i| format!("\"EXT_{}_{i}\"", "x".repeat(500)))
        .collect();
    let file = gltf(&format!(
        r#""materials":[{{}}],"extensionsUsed":[{}]"#,
        extensions.join(",")
    ));
    let loaded = loaded(SceneFormat::Gltf, &file);
    let losses = loaded.left_out.losses();
    assert!(losses.len() <= 65, "{}", losses.len());
    assert_eq!(losses.iter().map(|loss| loss.count).sum::<u64>(), 1000);
    for loss in losses {
        assert!(loss.reason.len() < 1000 && loss.examples.len() <= 8);
    }
}
