//! Compressed glTF: meshopt, Draco, WebP and Basis Universal. Each needs its feature.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![cfg(all(
    feature = "meshopt",
    feature = "draco",
    feature = "webp",
    feature = "basisu"
))]

mod common;

use antumbra_formats::{
    LoadOptions, LoadProblem, LoadedScene, SceneFormat, load_slice, load_slice_with_attachments,
};
use antumbra_scene::{Geometry, Scene};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

fn read(bytes: &[u8]) -> Result<Scene, LoadProblem> {
    let options = LoadOptions::default();
    load_slice(SceneFormat::Gltf, bytes, None, &options).map_err(|error| *error.problem)
}

fn only(scene: &Scene) -> Geometry {
    scene.meshes().next().unwrap().1.levels[0].clone()
}

const CORNERS: [[f32; 3]; 4] = [
    [-3.0, -3.0, 0.0],
    [3.0, -3.0, 0.0],
    [3.0, 3.0, 0.0],
    [-3.0, 3.0, 0.0],
];

/// A square whose positions and indices are compressed, with these members in the extensions of its two views.
fn meshopt_file(attributes: &str, triangles: &str) -> Vec<u8> {
    let positions = meshopt::encode_vertex_buffer(&CORNERS).unwrap();
    let indices = meshopt::encode_index_buffer(&[0, 1, 2, 0, 2, 3], 4).unwrap();
    let [first, second] = [positions.len(), indices.len()];
    let name = "EXT_meshopt_compression";
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"extensionsUsed":["{name}"],"extensionsRequired":["{name}"],
"buffers":[{{"byteLength":{}}},{{"byteLength":72,"extensions":{{"{name}":{{"fallback":true}}}}}}],
"bufferViews":[{{"buffer":1,"byteLength":48,"byteStride":12,"extensions":{{"{name}":{{"buffer":0,"byteLength":{first},"byteStride":12,"count":4,{attributes}}}}}}},
{{"buffer":1,"byteOffset":48,"byteLength":24,"extensions":{{"{name}":{{"buffer":0,"byteOffset":{first},"byteLength":{second},"byteStride":4,{triangles}}}}}}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},{{"bufferView":1,"componentType":5125,"count":6,"type":"SCALAR"}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"nodes":[{{"mesh":0}}]}}"#,
        first + second
    );
    common::glb(&json, &[positions, indices].concat())
}

const ATTRIBUTES: &str = r#""mode":"ATTRIBUTES""#;
const TRIANGLES: &str = r#""mode":"TRIANGLES","count":6"#;

#[test]
fn views_compressed_by_meshopt_are_decoded() {
    let found = only(&read(&meshopt_file(ATTRIBUTES, TRIANGLES)).unwrap());
    assert_eq!(found.positions, CORNERS);
    let area = found.triangles().map(|t| {
        let [a, b, c] = found.corners(t).unwrap();
        (b - a).cross(c - a).z / 2.0
    });
    assert_eq!(area.sum::<f64>(), 36.0);
}

#[test]
fn filters_of_meshopt_are_undone() {
    // Exponential: each word is a mantissa of 24 bits and an exponent of 8.
    let filtered = meshopt::encode_filter_exp(&CORNERS, 23, meshopt::EncodeExpMode::Separate);
    let positions = meshopt::encode_vertex_buffer(&filtered).unwrap();
    let length = positions.len();
    let name = "EXT_meshopt_compression";
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"extensionsRequired":["{name}"],"buffers":[{{"byteLength":{length}}},{{"byteLength":48}}],
"bufferViews":[{{"buffer":1,"byteLength":48,"byteStride":12,"extensions":{{"{name}":{{"buffer":0,"byteLength":{length},"byteStride":12,"count":4,"mode":"ATTRIBUTES","filter":"EXPONENTIAL"}}}}}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":0}}]}}],"nodes":[{{"mesh":0}}]}}"#
    );
    let found = only(&read(&common::glb(&json, &positions)).unwrap());
    assert_eq!(found.positions, CORNERS);
}

#[test]
fn wild_compressed_views_are_refused() {
    for (attributes, triangles) in [
        (r#""mode":"ATTRIBUTES","filter":"SEPIA""#, TRIANGLES),
        (r#""mode":"ATTRIBUTES","filter":"OCTAHEDRAL""#, TRIANGLES),
        (r#""mode":"VIBES""#, TRIANGLES),
        (ATTRIBUTES, r#""mode":"TRIANGLES","count":7"#),
        (ATTRIBUTES, r#""mode":"TRIANGLES","count":3"#),
        (ATTRIBUTES, r#""mode":"TRIANGLES","count":600000"#),
    ] {
        let problem = read(&meshopt_file(attributes, triangles)).unwrap_err();
        let is_named = problem.to_string().contains("buffer view");
        assert!(is_named, "{attributes} {triangles}: {problem}");
    }
    // What would take more memory than there may be is refused before it is taken.
    let problem = read(&meshopt_file(
        ATTRIBUTES,
        r#""mode":"TRIANGLES","count":300000000000"#,
    ));
    assert!(matches!(
        problem.unwrap_err(),
        LoadProblem::TooMuchMemory(_)
    ));
}

/// A square of two triangles as a Draco encoder (the reference's successor in Rust) writes it, without connectivity tricks: sequential.
const DRACO: &[u8] = &[
    68, 82, 65, 67, 79, 2, 2, 1, 1, 0, 0, 0, 4, 2, 0, 2, 0, 0, 1, 31, 255, 1, 17, 1, 255, 0, 0, 1,
    0, 9, 3, 0, 0, 2, 0, 1, 1, 0, 3, 3, 1, 32, 1, 32, 3, 0, 32, 132, 152, 144, 0, 0, 0, 0, 0, 255,
    63, 0, 0, 0, 0, 64, 192, 0, 0, 64, 192, 0, 0, 0, 0, 0, 0, 192, 64, 14,
];

fn draco_file(bytes: &[u8], attribute: u32) -> Vec<u8> {
    let length = bytes.len();
    let name = "KHR_draco_mesh_compression";
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"extensionsUsed":["{name}"],"extensionsRequired":["{name}"],
"buffers":[{{"byteLength":{length}}}],"bufferViews":[{{"buffer":0,"byteLength":{length}}}],
"accessors":[{{"componentType":5126,"count":4,"type":"VEC3"}},{{"componentType":5125,"count":6,"type":"SCALAR"}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"extensions":{{"{name}":{{"bufferView":0,"attributes":{{"POSITION":{attribute}}}}}}}}}]}}],"nodes":[{{"mesh":0}}]}}"#
    );
    common::glb(&json, bytes)
}

#[test]
fn primitives_compressed_by_draco_are_decoded() {
    let found = only(&read(&draco_file(DRACO, 0)).unwrap());
    assert_eq!(found.triangle_count(), 2);
    let area = found.triangles().map(|t| {
        let [a, b, c] = found.corners(t).unwrap();
        (b - a).cross(c - a).z / 2.0
    });
    assert!((area.sum::<f64>() - 36.0).abs() < 0.02, "of 14 bits");
}

#[test]
fn wild_draco_is_refused_or_harmless() {
    let problem = read(&draco_file(DRACO, 9)).unwrap_err();
    assert!(problem.to_string().contains("no attribute 9"), "{problem}");
    for length in 0..DRACO.len() {
        let problem = read(&draco_file(&DRACO[..length], 0)).unwrap_err();
        let is_named = problem.to_string().contains("mesh 0, primitive 0");
        assert!(is_named, "{length}: {problem}");
    }
    // Any other byte: an error, or a scene within its own bounds.
    for at in 0..DRACO.len() {
        for byte in [0, 1, 127, 128, 255] {
            let mut wild = DRACO.to_vec();
            wild[at] = byte;
            if let Ok(scene) = read(&draco_file(&wild, 0)) {
                assert!(only(&scene).problem().is_none(), "byte {at} as {byte}");
            }
        }
    }
}

/// A glTF of a square with this image under this extension.
fn textured(extension: &str, mime: &str, image: &[u8]) -> LoadedScene {
    let data = STANDARD.encode(image);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},{},"extensionsRequired":["{extension}"],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],"nodes":[{{"mesh":0}}],
"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],"textures":[{{"extensions":{{"{extension}":{{"source":0}}}}}}],"images":[{{"uri":"data:{mime};base64,{data}"}}]}}"#,
        common::SQUARE
    );
    let file = common::glb(&json, &common::square());
    load_slice_with_attachments(SceneFormat::Gltf, &file, None, &LoadOptions::default(), &[])
        .unwrap()
}

#[test]
fn webp_is_read() {
    // Red above and blue below, without loss.
    let webp = STANDARD
        .decode("UklGRiAAAABXRUJQVlA4TBMAAAAvB8ABAA8Q87//8x8O5j+i//EAAA==")
        .unwrap();
    let loaded = textured("EXT_texture_webp", "image/webp", &webp);
    let (_, image) = loaded.scene.images().next().expect("it is read");
    assert_eq!((image.width, image.height), (8, 8));
    assert_eq!(image.rgba[..4], [255, 0, 0, 255]);
    assert_eq!(image.rgba[252..], [0, 0, 255, 255]);
    assert!(loaded.left_out.is_empty());
}

/// A KTX2 of one block of 4 x 4 pixels in UASTC: mode 8 is a single colour.
fn ktx2(width: u32, height: u32, block: [u8; 16]) -> Vec<u8> {
    let mut file = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    let mut words = |words: &[u32]| file.extend(words.iter().flat_map(|w| w.to_le_bytes()));
    // No format, bytes, the size, no layers, one face and level, no supercompression.
    words(&[0, 1, width, height, 0, 0, 1, 1, 0]);
    // The places of the format's description, of nothing, and of nothing.
    words(&[104, 44, 0, 0, 0, 0, 0, 0]);
    // The level's place, its length, and again.
    words(&[148 + 12, 0, 16, 0, 16, 0]);
    // The description: UASTC (166), BT.709, sRGB, blocks of 4 x 4 in 16 bytes, one sample of 128 bits.
    words(&[
        44,
        0,
        2 | 40 << 16,
        166 | 1 << 8 | 2 << 16,
        3 | 3 << 8,
        16,
        0,
    ]);
    words(&[127 << 16 | 3 << 24, 0, 0, u32::MAX]);
    file.resize(160, 0);
    file.extend(block);
    file
}

/// The block of one colour: five bits of the mode, then eight for each channel.
fn solid([r, g, b, a]: [u8; 4]) -> [u8; 16] {
    let channels = u128::from(r) | u128::from(g) << 8 | u128::from(b) << 16 | u128::from(a) << 24;
    (0x17 | channels << 5).to_le_bytes()
}

#[test]
fn ktx2_is_read() {
    let file = ktx2(4, 4, solid([10, 200, 30, 255]));
    let loaded = textured("KHR_texture_basisu", "image/ktx2", &file);
    let (_, image) = loaded
        .scene
        .images()
        .next()
        .unwrap_or_else(|| panic!("{}", loaded.left_out));
    assert_eq!((image.width, image.height), (4, 4));
    for pixel in image.rgba.as_chunks::<4>().0 {
        assert_eq!(*pixel, [10, 200, 30, 255]);
    }
}

#[test]
fn wild_ktx2_costs_the_image_alone() {
    let file = ktx2(4, 4, solid([0; 4]));
    for length in [0, 12, 40, 100, 150, 170] {
        let loaded = textured("KHR_texture_basisu", "image/ktx2", &file[..length]);
        assert_eq!(loaded.scene.triangle_count(), 2);
        assert_eq!(loaded.left_out.losses().len(), 1, "{length}");
    }
    for at in 12..file.len() {
        for byte in [0, 1, 127, 255] {
            let mut wild = file.clone();
            wild[at] = byte;
            // The size alone may exceed the limits; all else is an image or none.
            if !(20..28).contains(&at) {
                textured("KHR_texture_basisu", "image/ktx2", &wild);
            }
        }
    }
}
