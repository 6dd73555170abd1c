//! Malformed files and their errors: the cause, the location, and no memory allocated for absent data.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_formats::{LoadOptions, LoadProblem, SceneFormat, load, load_slice};
use common::{floats, primitive, scene};

fn refused(format: SceneFormat, bytes: &[u8]) -> LoadProblem {
    *load_slice(format, bytes, None, &LoadOptions::default())
        .unwrap_err()
        .problem
}

fn gltf(bytes: &[u8]) -> LoadProblem {
    refused(SceneFormat::Gltf, bytes)
}

macro_rules! assert_problem {
    ($problem:expr, $pattern:pat, $($part:expr),*) => {{
        let problem = $problem;
        let text = problem.to_string();
        assert!(matches!(problem, $pattern), "{problem:?}");
        $(assert!(text.contains($part), "{:?} is not in {text}", $part);)*
    }};
}

const ONE: &str = r#"{"mesh":0}"#;

#[test]
fn every_truncation_is_an_error() {
    let files = [
        (SceneFormat::Gltf, scene(ONE, "")),
        (SceneFormat::Ply, common::ply_binary()),
        (SceneFormat::Stl, common::stl_binary(b"", 3)),
    ];
    for (format, file) in files {
        assert!(load_slice(format, &file, None, &LoadOptions::default()).is_ok());
        for length in 0..file.len() {
            let cut = load_slice(format, &file[..length], None, &LoadOptions::default());
            assert!(
                cut.is_err(),
                "{format:?} cut to {length} of {} bytes",
                file.len()
            );
        }
    }
}

#[test]
fn a_glb_that_promises_more_than_it_has_is_truncated() {
    let mut file = scene(ONE, "");
    let length = file.len() as u32 + 4;
    file[8..12].copy_from_slice(&length.to_le_bytes());
    assert_problem!(
        gltf(&file),
        LoadProblem::Truncated { .. },
        "GLB file",
        "get it again"
    );
    let mut file = scene(ONE, "");
    file[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_problem!(
        gltf(&file),
        LoadProblem::Truncated { .. },
        "chunk 0",
        "4294967295"
    );
}

#[test]
fn buffers_views_and_accessors_cannot_reach_beyond_their_bytes() {
    let base = String::from_utf8(scene(ONE, "")[20..].to_vec());
    assert!(base.is_err(), "the binary chunk is no text");
    let broken = |from: &str, to: &str| {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},{},"meshes":[{{"name":"square","primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"nodes":[{ONE}]}}"#,
            common::SQUARE
        );
        assert!(json.contains(from), "{from}");
        gltf(&common::glb(&json.replacen(from, to, 1), &common::square()))
    };
    assert_problem!(
        broken(r#"[{"byteLength":60}]"#, r#"[{"byteLength":61}]"#),
        LoadProblem::Truncated { needed: 61, .. },
        "buffer 0"
    );
    assert_problem!(
        broken(r#""byteOffset":48"#, r#""byteOffset":49"#),
        LoadProblem::Truncated { .. },
        "buffer view 1"
    );
    assert_problem!(
        broken(r#""byteOffset":48"#, r#""byteOffset":18446744073709551615"#),
        LoadProblem::Truncated { .. },
        "buffer view 1"
    );
    assert_problem!(
        broken(r#""count":4"#, r#""count":4000000000"#),
        LoadProblem::Truncated { .. },
        "POSITION of mesh 0 \"square\""
    );
    assert_problem!(
        broken(r#""count":4"#, r#""count":99999999999999"#),
        LoadProblem::BadAccessor { .. },
        "99999999999999"
    );
    assert_problem!(
        broken(r#""count":6"#, r#""count":9"#),
        LoadProblem::Truncated { .. },
        "indices of mesh 0"
    );
    assert_problem!(
        broken(r#""byteLength":48"#, r#""byteLength":48,"byteStride":4"#),
        LoadProblem::BadAccessor { .. },
        "stride of 4"
    );
    assert_problem!(
        broken(r#""byteLength":48"#, r#""byteLength":48,"byteStride":0"#),
        LoadProblem::BadAccessor { .. },
        "stride of 0"
    );
    assert_problem!(
        broken(r#""bufferView":0"#, r#""bufferView":7"#),
        LoadProblem::MissingReference { index: 7, .. },
        "buffer view 7",
        "there are 2"
    );
    assert_problem!(
        broken(r#""buffer":0"#, r#""buffer":1"#),
        LoadProblem::MissingReference { .. },
        "buffer 1"
    );
    assert_problem!(
        broken(r#""POSITION":0"#, r#""POSITION":9"#),
        LoadProblem::MissingReference { .. },
        "accessor 9"
    );
    assert_problem!(
        broken(r#""type":"VEC3""#, r#""type":"VEC2""#),
        LoadProblem::BadAccessor { .. },
        "cannot be positions"
    );
    assert_problem!(
        broken("5123", "5126"),
        LoadProblem::Truncated { .. },
        "indices"
    );
    assert_problem!(
        broken("5123", "1"),
        LoadProblem::BadAccessor { .. },
        "unknown"
    );
    assert_problem!(
        broken(r#""count":6"#, r#""count":5"#),
        LoadProblem::BadPrimitive { .. },
        "5 indices",
        "Triangles"
    );
}

#[test]
fn memory_is_not_taken_for_what_has_no_bytes() {
    // An accessor without a view is all zeros and may have any length.
    let file = primitive(
        r#"{"attributes":{"POSITION":0},"mode":0}"#,
        "",
        r#"{"componentType":5126,"count":4000000000,"type":"VEC3"}"#,
        &[],
    );
    assert_problem!(
        gltf(&file),
        LoadProblem::TooLarge { .. },
        "4000000000",
        "max_triangles"
    );
    let objects = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{}{{}}]}}"#,
        "{},".repeat(999)
    );
    let options = LoadOptions {
        max_json_objects: 1000,
        ..LoadOptions::default()
    };
    let error = load_slice(SceneFormat::Gltf, objects.as_bytes(), None, &options).unwrap_err();
    assert_problem!(
        *error.problem,
        LoadProblem::TooLarge { amount: 1065, .. },
        "max_json_objects"
    );
    let nodes = vec![ONE; 20].join(",");
    let options = LoadOptions {
        max_entities: 19,
        ..LoadOptions::default()
    };
    let error = load_slice(SceneFormat::Gltf, &scene(&nodes, ""), None, &options).unwrap_err();
    assert_problem!(
        *error.problem,
        LoadProblem::TooLarge { .. },
        "20 entities",
        "max_entities"
    );
}

#[test]
fn numbers_that_are_not_finite_are_named() {
    for bad in [f32::NAN, f32::INFINITY] {
        let file = primitive(
            r#"{"attributes":{"POSITION":0}}"#,
            r#"{"buffer":0,"byteLength":36}"#,
            r#"{"name":"corners","bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}"#,
            &floats(&[0., 0., 0., 1., bad, 0., 0., 1., 0.]),
        );
        assert_problem!(
            gltf(&file),
            LoadProblem::BadAccessor { .. },
            "\"corners\"",
            "element 1 is not finite"
        );
    }
    let huge = scene(r#"{"name":"far","scale":[1e39,1,1],"mesh":0}"#, "");
    // The number exceeds f32. The JSON reader or the check of nodes reports it, depending on the reader's precision
    // feature.
    let problem = gltf(&huge);
    assert!(
        matches!(
            problem,
            LoadProblem::BadNode { .. } | LoadProblem::Syntax { .. }
        ),
        "{problem:?}"
    );
    let flat = scene(r#"{"name":"turned","rotation":[0,0,0,0],"mesh":0}"#, "");
    assert_problem!(
        gltf(&flat),
        LoadProblem::BadNode { .. },
        "\"turned\"",
        "rotation"
    );
    for beyond in [
        r#""translation":[0,-1e39,0]"#,
        r#""rotation":[0,0,1e39,1]"#,
        r#""matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 1e39,0,0,1]"#,
        r#""scale":[1e999,1,1]"#,
    ] {
        let problem = gltf(&scene(&format!("{{{beyond}}}"), ""));
        assert!(
            matches!(
                problem,
                LoadProblem::BadNode { .. } | LoadProblem::Syntax { .. }
            ),
            "{problem:?}"
        );
    }
    let short = scene(r#"{"name":"turned","rotation":[0,0,0,1e-60]}"#, "");
    assert_problem!(gltf(&short), LoadProblem::BadNode { .. }, "no length");
    // A node as an array of its members, which the JSON reader would accept as a struct.
    let array = scene(
        "[null,null,null,null,null,0,null,[0,0,0,1],null,null,null,null]",
        "",
    );
    assert_problem!(gltf(&array), LoadProblem::BadNode { .. }, "no JSON object");
    let projective = scene(r#"{"matrix":[1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]}"#, "");
    assert_problem!(gltf(&projective), LoadProblem::BadNode { .. }, "affine");
}

#[test]
fn indices_out_of_range_are_named() {
    let mut binary = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
    binary.extend([0, 1, 3]);
    let file = primitive(
        r#"{"attributes":{"POSITION":0},"indices":1}"#,
        r#"{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}"#,
        r#"{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}"#,
        &binary,
    );
    assert_problem!(
        gltf(&file),
        LoadProblem::BadAccessor { .. },
        "element 2 is 3",
        "only 3 vertices"
    );
}

#[test]
fn nodes_that_are_no_tree_are_refused() {
    let cycle = r#"{"name":"a","children":[1]},{"children":[0]}"#;
    assert_problem!(
        gltf(&scene(cycle, "")),
        LoadProblem::NodeCycle { .. },
        "node 0 \"a\"",
        "its own ancestor"
    );
    assert_problem!(
        gltf(&scene(r#"{"children":[0]}"#, "")),
        LoadProblem::NodeCycle { .. },
        "node 0"
    );
    let two = r#"{"children":[2]},{"children":[2]},{"name":"c"}"#;
    assert_problem!(
        gltf(&scene(two, "")),
        LoadProblem::TwoParents { .. },
        "node 2 \"c\"",
        "node 0",
        "node 1"
    );
    let root = r#","scenes":[{"nodes":[0,1]}]"#;
    assert_problem!(
        gltf(&scene(r#"{"children":[1]},{}"#, root)),
        LoadProblem::TwoParents { .. },
        "the scene"
    );
    assert_problem!(
        gltf(&scene("{},{}", r#","scenes":[{"nodes":[0,0]}]"#)),
        LoadProblem::TwoParents { .. },
        "node 0"
    );
    assert_problem!(
        gltf(&scene(r#"{"children":[5]}"#, "")),
        LoadProblem::MissingReference { .. },
        "node 5"
    );
    assert_problem!(
        gltf(&scene(r#"{"mesh":5}"#, "")),
        LoadProblem::MissingReference { .. },
        "node 0",
        "mesh 5"
    );
}

#[test]
fn required_extensions_must_be_known() {
    let file = scene(
        ONE,
        r#","extensionsRequired":["KHR_mesh_quantization","EXT_unheard_of"]"#,
    );
    assert_problem!(
        gltf(&file),
        LoadProblem::UnsupportedExtension { .. },
        "EXT_unheard_of",
        "MSFT_lod",
        "export"
    );
    let used = scene(ONE, r#","extensionsUsed":["KHR_draco_mesh_compression"]"#);
    assert!(load_slice(SceneFormat::Gltf, &used, None, &LoadOptions::default()).is_ok());
}

#[test]
fn nothing_outside_the_folder_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("inside");
    std::fs::create_dir(&inside).unwrap();
    std::fs::write(folder.path().join("secret.bin"), common::square()).unwrap();
    std::fs::write(inside.join("own file.bin"), common::square()).unwrap();
    std::os::unix::fs::symlink(folder.path().join("secret.bin"), inside.join("link.bin")).unwrap();
    let with = |uri: &str| {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},{},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"nodes":[{ONE}]}}"#,
            common::SQUARE
        );
        let json = json.replacen(
            r#"[{"byteLength":60}]"#,
            &format!(r#"[{{"byteLength":60,"uri":"{uri}"}}]"#),
            1,
        );
        let path = inside.join("scene.gltf");
        std::fs::write(&path, json).unwrap();
        load(&path, &LoadOptions::default())
    };
    let mut loaded = with("own%20file.bin").unwrap();
    assert_eq!(loaded.update().added.len(), 1);
    let absolute = folder.path().join("secret.bin");
    for uri in [
        "../secret.bin",
        "..%2fsecret.bin",
        "link.bin",
        "a/../../secret.bin",
        "..\\\\secret.bin",
        "file:///etc/passwd",
        absolute.to_str().unwrap(),
    ] {
        let error = with(uri).unwrap_err();
        assert!(error.to_string().contains("scene.gltf"), "{error}");
        assert_problem!(
            *error.problem,
            LoadProblem::BadUri { .. },
            "buffer 0",
            "own folder"
        );
    }
    assert_problem!(
        *with("gone.bin").unwrap_err().problem,
        LoadProblem::Io { .. },
        "gone.bin"
    );
    assert_problem!(
        *with("data:nothing").unwrap_err().problem,
        LoadProblem::BadUri { .. },
        "comma"
    );
    assert_problem!(
        *with("data:;base64,?").unwrap_err().problem,
        LoadProblem::BadUri { .. },
        "broken"
    );
}

#[test]
fn images_are_decoded_within_limits() {
    let png = |bytes: &[u8]| {
        use base64::Engine;
        let data = base64::engine::general_purpose::STANDARD.encode(bytes);
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},{},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],"nodes":[{ONE}],
"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],"textures":[{{"source":0}}],"images":[{{"name":"bark","uri":"data:image/png;base64,{data}"}}]}}"#,
            common::SQUARE
        );
        common::glb(&json, &common::square())
    };
    for broken in [&common::PNG[..40], b"GIF89a"] {
        let read = load_slice(
            SceneFormat::Gltf,
            &png(broken),
            None,
            &LoadOptions::default(),
        );
        assert_eq!(
            read.unwrap().images().count(),
            0,
            "it costs the image alone"
        );
    }
    // The header promises 2^31 by 2^31 pixels.
    let mut huge = common::PNG.to_vec();
    huge[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    // The limits, or the decoder, which costs the image alone.
    match load_slice(
        SceneFormat::Gltf,
        &png(&huge),
        None,
        &LoadOptions::default(),
    ) {
        Ok(scene) => assert_eq!(scene.images().count(), 0),
        Err(error) => assert_problem!(*error.problem, LoadProblem::TooLarge { .. }, "pixels"),
    }
    let few = LoadOptions {
        max_image_pixels: 1,
        ..LoadOptions::default()
    };
    let error = load_slice(SceneFormat::Gltf, &png(common::PNG), None, &few).unwrap_err();
    assert_problem!(
        *error.problem,
        LoadProblem::TooLarge { .. },
        "max_image_pixels"
    );
    let skip = LoadOptions {
        skip_images: true,
        ..LoadOptions::default()
    };
    assert!(load_slice(SceneFormat::Gltf, &png(b"GIF89a"), None, &skip).is_ok());
}

#[test]
fn counts_in_headers_are_held_against_the_bytes() {
    let mut stl = common::stl_binary(b"", 2);
    stl[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_problem!(
        refused(SceneFormat::Stl, &stl),
        LoadProblem::Truncated { .. },
        "4294967295 triangles"
    );
    let ply = common::PLY.replace("vertex 4", "vertex 4000000000");
    assert_problem!(
        refused(SceneFormat::Ply, ply.as_bytes()),
        LoadProblem::Truncated { .. },
        "\"vertex\""
    );
    // Elements without properties take no bytes, but still count.
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nend_header\n";
    assert_problem!(
        refused(SceneFormat::Ply, ply.as_bytes()),
        LoadProblem::Truncated { .. },
        "\"vertex\""
    );
    let mut ply = common::ply_binary();
    let at = ply.len() - 13;
    ply[at] = 255;
    assert_problem!(
        refused(SceneFormat::Ply, &ply),
        LoadProblem::Syntax { .. },
        "face"
    );
}

#[test]
fn what_does_not_follow_the_format_says_where() {
    assert_problem!(
        gltf(b"{\"asset\":"),
        LoadProblem::Syntax { .. },
        "JSON",
        "line 1"
    );
    assert_problem!(
        gltf(br#"{"asset":{"version":"1.0"}}"#),
        LoadProblem::Syntax { .. },
        "asset.version",
        "1.0",
        "convert"
    );
    assert_problem!(
        refused(SceneFormat::Ply, b"plx"),
        LoadProblem::Syntax { .. },
        "PLY"
    );
    assert_problem!(
        refused(SceneFormat::Obj, b"v 1 nothing 3\n"),
        LoadProblem::Syntax { .. },
        "OBJ",
        "position"
    );
    assert_problem!(
        refused(SceneFormat::Obj, b"v 0 0 0\nf 1 2 3\n"),
        LoadProblem::Syntax { .. },
        "OBJ",
        "bounds"
    );
    assert_problem!(
        refused(
            SceneFormat::Stl,
            common::STL.replace("endloop", "end").as_bytes()
        ),
        LoadProblem::Syntax { .. },
        "STL",
        "triangle 0"
    );
    let error = load(std::path::Path::new("scene.fbx"), &LoadOptions::default()).unwrap_err();
    assert_problem!(
        *error.problem,
        LoadProblem::UnknownExtension { .. },
        "fbx",
        ".glb, .gltf, .json, .jsonl, .obj, .ply, .stl"
    );
}

/// Found by the fuzzer: the OBJ crate overflows on such corners and unwraps such colours.
#[test]
fn wild_obj_corners_and_colours_do_no_harm() {
    let with =
        |corner: &str| format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1 2 {corner}\n");
    for corner in [
        "3/1/-2",
        "-4",
        "0",
        "3/9223372036854775807",
        "-9223372036854775808",
        "/1",
        "3/1/1/1",
        "3/x",
        "99999999999999999999",
    ] {
        let problem = refused(SceneFormat::Obj, with(corner).as_bytes());
        assert_problem!(
            problem,
            LoadProblem::Syntax { .. },
            "line 6",
            corner.get(..20).unwrap_or(corner)
        );
    }
    assert_problem!(
        refused(SceneFormat::Obj, with("4").as_bytes()),
        LoadProblem::Syntax { .. },
        "bounds"
    );
    for corner in ["3", "-1", "3/1/1", "-1/-1/-1", "3//1", "3/1"] {
        let read = load_slice(
            SceneFormat::Obj,
            with(corner).as_bytes(),
            None,
            &LoadOptions::default(),
        );
        assert_eq!(read.unwrap().triangle_count(), 1, "{corner}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grey.obj");
    std::fs::write(
        &path,
        format!("mtllib grey.mtl\nusemtl\nusemtl grey\n{}", with("3")),
    )
    .unwrap();
    std::fs::write(
        folder.path().join("grey.mtl"),
        "Kd\nnewmtl\nnewmtl grey\nKa 1\nKd 0.5\nmap_Kd\n",
    )
    .unwrap();
    let scene = load(&path, &LoadOptions::default()).unwrap();
    assert_eq!(
        scene.materials().next().unwrap().1.base_colour,
        [0.5, 0.5, 0.5, 1.0]
    );
}
