//! Texts as exporters write them: other cases, blank lines, byte order marks, continued lines, other line ends.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_formats::{LoadOptions, SceneFormat, load, load_slice, load_with_attachments};
use antumbra_scene::{Material, Scene, Wrap};
use std::path::Path;

fn triangles(format: SceneFormat, bytes: &[u8]) -> u64 {
    let scene = load_slice(format, bytes, None, &LoadOptions::default()).unwrap();
    scene.triangle_count()
}

#[test]
fn ascii_stl_is_read_in_any_case_and_with_any_space() {
    let upper = common::STL.to_uppercase();
    let end = common::STL.replace("endsolid", "end solid");
    let split = end
        .replace("endloop", "end loop")
        .replace("endfacet", "end facet");
    let nan = common::STL.replace("normal 0 0 1", "normal nan nan nan");
    for text in [
        format!("\n  \n{}", common::STL),
        format!("\u{feff}{}", common::STL),
        upper,
        end,
        split,
        nan,
        common::STL.replace('\n', "\r\n"),
        common::STL.replace('\n', "\r"),
        common::STL.replace('\n', "\n\n\t"),
    ] {
        assert_eq!(triangles(SceneFormat::Stl, text.as_bytes()), 1, "{text}");
    }
}

#[test]
fn obj_lines_continue_and_end_with_comments() {
    let corners = "v 0 0 0 # the first\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    for face in [
        "f 1 2 \\\n 3 4\n",
        "f 1 2\\\r\n3 \\\r\n 4\r\n",
        "f 1 2 3 4 # a square",
        "g a#b\nf 1 2 3 4\n",
        "f 1 2 3 \\\n\nf 1 3 4\n",
        "f 1 2 3 \\\n \nf 1 3 4\n",
    ] {
        let text = format!("\u{feff}{corners}{face}");
        assert_eq!(triangles(SceneFormat::Obj, text.as_bytes()), 2, "{face}");
    }
    let text = format!("{corners}usemtl a#1 # comment\nf 1 2 3 4\n").replace('\n', "\r");
    assert_eq!(triangles(SceneFormat::Obj, text.as_bytes()), 2);
}

#[test]
fn errors_name_the_line_for_any_line_ends() {
    let obj = "\n# a comment\nv 0 0 0\n\nv 1 \\\n 0 0\nv 0 1 0\nf 1 2 9\n";
    let odd = "v 0 0 0\n\nv 0 a 0\n";
    let stl = "\n\nsolid a\nfacet normal 0 0 1\nouter loop\nvertex 0 b 0\n";
    let files = [
        (SceneFormat::Obj, obj, "line 8 "),
        (SceneFormat::Obj, odd, "line 3 "),
        (SceneFormat::Stl, stl, "line 6 "),
    ];
    for (format, text, line) in files {
        for end in ["\n", "\r\n", "\r"] {
            let text = text.replace('\n', end);
            let options = LoadOptions::default();
            let error = load_slice(format, text.as_bytes(), None, &options).unwrap_err();
            let message = error.to_string();
            assert!(message.contains(line), "{end:?}, {line}: {message}");
        }
    }
}

#[test]
fn facets_of_an_stl_begin_and_end_in_turn() {
    for (text, words) in [
        (common::STL.replace("endfacet\n", ""), "truncated"),
        (
            common::STL.replace("endfacet\n", "facet normal 0 0 1\nendfacet\n"),
            "line 8 ",
        ),
        (
            common::STL.replace("endfacet\n", "endfacet\nendfacet\n"),
            "line 9 ",
        ),
    ] {
        let options = LoadOptions::default();
        let error = load_slice(SceneFormat::Stl, text.as_bytes(), None, &options).unwrap_err();
        let message = error.to_string();
        assert!(message.contains(words), "{words}: {message}");
    }
}

#[test]
fn ply_headers_end_lines_as_they_like() {
    assert_eq!(triangles(SceneFormat::Ply, common::PLY.as_bytes()), 2);
    let blank = common::PLY.replace("end_header\n", "end_header\n\n");
    assert_eq!(triangles(SceneFormat::Ply, blank.as_bytes()), 2);
    for end in ["\r\n", "\r"] {
        let ascii = common::PLY.replace('\n', end);
        assert_eq!(triangles(SceneFormat::Ply, ascii.as_bytes()), 2, "{end:?}");
        let binary = common::ply_binary();
        let at = binary
            .windows(11)
            .position(|w| w == b"end_header\n")
            .unwrap()
            + 11;
        let mut file = String::from_utf8(binary[..at].to_vec())
            .unwrap()
            .replace('\n', end)
            .into_bytes();
        file.extend(&binary[at..]);
        assert_eq!(triangles(SceneFormat::Ply, &file), 1, "{end:?}");
    }
}

/// A glTF of a textured square whose image has this URI.
fn textured(uri: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},{},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],"nodes":[{{"mesh":0}}],
"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],"textures":[{{"source":0}}],"images":[{{"uri":"{uri}"}}]}}"#,
        common::SQUARE
    )
}

#[test]
fn data_uris_are_read_as_browsers_read_them() {
    use base64::Engine;
    let data = base64::engine::general_purpose::STANDARD.encode(common::PNG);
    let (first, rest) = data.split_at(20);
    let all_percent: String = common::PNG
        .iter()
        .map(|byte| format!("%{byte:02x}"))
        .collect();
    for uri in [
        format!("data:image/png;base64,{data}"),
        format!("DATA:image/png;BASE64,{data}"),
        format!("data:image/png;base64,{first}\\n{rest}"),
        format!(
            "data:image/png;base64,{first}%0a{}",
            rest.replace('=', "%3D")
        ),
        format!("data:image/png,{all_percent}"),
    ] {
        let file = common::glb(&textured(&uri), &common::square());
        let scene = load_slice(SceneFormat::Gltf, &file, None, &LoadOptions::default()).unwrap();
        assert_eq!(scene.images().count(), 1, "{uri}");
    }
}

/// An OBJ of a textured square beside these files, loaded; what was left out, in words.
fn with_library(library: &str, files: &[(&str, &[u8])]) -> (Scene, String) {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    };
    for (name, bytes) in files {
        write(name, bytes);
    }
    write("m.mtl", library.as_bytes());
    let obj = "mtllib m.mtl\nv -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n";
    write("a.obj", obj.as_bytes());
    let path = folder.path().join("a.obj");
    let loaded = load_with_attachments(&path, &LoadOptions::default(), &[]).unwrap();
    assert_eq!(loaded.scene.triangle_count(), 2);
    (loaded.scene, loaded.left_out.to_string())
}

fn only(scene: &Scene) -> Material {
    scene.materials().next().unwrap().1.clone()
}

#[test]
fn maps_of_a_library_have_options_and_any_spelling() {
    for name in [
        "red.png",
        "RED.PNG",
        ".\\red.png",
        "C:\\work\\maps\\red.png",
        "-s 1 1 1 -o 0 0 0 red.png",
        "-blendu on -clamp off -bm 2.5 -mm 0 1 red.png",
        "\"red.png\"",
    ] {
        let (scene, lost) = with_library(
            &format!("newmtl m\nmap_Kd {name}\n"),
            &[("red.png", common::PNG)],
        );
        assert_eq!(scene.images().count(), 1, "{name}: {lost}");
        assert_eq!(lost, "", "{name}");
    }
    let (scene, _) = with_library(
        "newmtl m\nmap_Kd -clamp on -s 2 3 -o 0.5 0.25 maps/in this folder.png\n",
        &[("maps/In This Folder.png", common::PNG)],
    );
    let (_, image) = scene.images().next().unwrap();
    assert_eq!(image.sampler.wrap_u, Wrap::Clamp);
    // The file's v counts from the bottom: 1 - (3 (1 - v) + 0.25).
    assert_eq!(
        only(&scene).uv_transform,
        [[2.0, 0.0, 0.5], [0.0, 3.0, -2.25]]
    );
}

/// Two pixels as an uncompressed Targa, blue and red.
const TARGA: &[u8] = &[
    0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 24, 0, 255, 0, 0, 0, 0, 255,
];

/// One red pixel as a Windows bitmap.
const BITMAP: &[u8] = &[
    b'B', b'M', 58, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0,
    24, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0,
];

#[test]
fn targa_and_bitmaps_are_read() {
    let (scene, lost) = with_library("newmtl m\nmap_Kd a.tga\n", &[("a.tga", TARGA)]);
    let (_, image) = scene.images().next().expect(&lost);
    assert_eq!(image.rgba, [0, 0, 255, 255, 255, 0, 0, 255]);
    let (scene, lost) = with_library("newmtl m\nmap_Kd a.bmp\n", &[("a.bmp", BITMAP)]);
    let (_, image) = scene.images().next().expect(&lost);
    assert_eq!(image.rgba, [255, 0, 0, 255]);
}

#[test]
fn libraries_say_what_glows() {
    let (scene, _) = with_library("newmtl m\nKd 0 0 0\nKe 0 1 0\n", &[]);
    assert_eq!(only(&scene).emission, [0.0, 1.0, 0.0]);
}

#[test]
fn images_of_emission_are_shown_on_black_surfaces_alone() {
    let files = [("red.png", common::PNG)];
    let (scene, lost) = with_library("newmtl m\nKd 0 0 0\nKe 1 0.5 0\nmap_Ke red.png\n", &files);
    let lamp = only(&scene);
    assert!(lamp.unlit && lamp.base_colour_image.is_some(), "{lost}");
    assert_eq!(lamp.base_colour, [1.0, 0.5, 0.0, 1.0]);
    assert_eq!((lamp.emission, lost.as_str()), ([0.0; 3], ""));
    let (scene, lost) = with_library("newmtl m\nKd 0 0 0\nmap_Ke red.png\n", &files);
    assert_eq!(only(&scene).base_colour, [1.0; 4], "{lost}");
    for colour in ["Kd 1 0 0", "map_Kd red.png\nKd 0 0 0"] {
        let library = format!("newmtl m\n{colour}\nKe 1 1 1\nmap_Ke red.png\n");
        let (scene, lost) = with_library(&library, &files);
        let coloured = only(&scene);
        assert_eq!((coloured.emission, coloured.unlit), ([0.0; 3], false));
        assert_eq!(lost, "1 shading detail (maps of emission)");
    }
}

#[test]
fn an_image_of_several_materials_is_read_once() {
    let folder = tempfile::tempdir().unwrap();
    let library =
        "newmtl a\nmap_Kd red.png\nnewmtl b\nmap_Kd red.png\nnewmtl c\nmap_Kd -clamp on red.png\n";
    std::fs::write(folder.path().join("m.mtl"), library).unwrap();
    std::fs::write(folder.path().join("red.png"), common::PNG).unwrap();
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let faces = ["a", "b", "c"].map(|name| format!("usemtl {name}\nf 1 2 3\n"));
    let path = folder.path().join("a.obj");
    std::fs::write(&path, format!("mtllib m.mtl\n{corners}{}", faces.concat())).unwrap();
    let scene = load(&path, &LoadOptions::default()).unwrap();
    assert_eq!(scene.materials().count(), 3);
    assert_eq!(scene.images().count(), 2, "one for each way of sampling it");
}

#[test]
fn a_library_whose_name_has_spaces_is_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    std::fs::write(folder.path().join("my library.mtl"), "newmtl m\nKd 1 0 0\n").unwrap();
    std::fs::write(
        &path,
        "mtllib my library.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    )
    .unwrap();
    let scene = load(Path::new(&path), &LoadOptions::default()).unwrap();
    assert_eq!(only(&scene).base_colour, [1.0, 0.0, 0.0, 1.0]);
}
