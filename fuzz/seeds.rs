//! Writes the small files that the fuzzer starts from into `corpus/loaders`.

#[path = "../crates/scene/tests/common/mod.rs"]
mod common;

use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus/loaders");
    std::fs::create_dir_all(&folder)?;
    let gltf = [
        common::scene(r#"{"mesh":0,"translation":[1,2,3],"children":[1]},{"mesh":0,"scale":[2,2,2]}"#, ""),
        common::scene(
            r#"{"mesh":0,"extensions":{"MSFT_lod":{"ids":[1]},"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}},{"mesh":0},{"camera":0}"#,
            r#","cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],"extensionsUsed":["MSFT_lod"]"#,
        ),
        common::primitive(
            r#"{"attributes":{"POSITION":0,"COLOR_0":1},"mode":5,"targets":[{"POSITION":0}]}"#,
            r#"{"buffer":0,"byteLength":36},{"buffer":0,"byteLength":12}"#,
            r#"{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}},{"bufferView":1,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"}"#,
            &common::floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]),
        ),
        br#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"skin":0}],"skins":[{"joints":[0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":1},"material":0}],"weights":[1]}],"materials":[{"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0,1],"rotation":1}}}}}],"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,iVBORw0KGgo="}],"accessors":[{"componentType":5126,"count":3,"type":"VEC3"},{"componentType":5121,"count":3,"type":"VEC4"}],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","spot":{}}]}}}"#.to_vec(),
    ];
    let others = [
        (1, common::OBJ.as_bytes().to_vec()),
        (2, common::PLY.as_bytes().to_vec()),
        (2, common::ply_binary()),
        (3, common::STL.as_bytes().to_vec()),
        (3, common::stl_binary(b"solid", 2)),
    ];
    let gltf = gltf.into_iter().map(|file| (0, file));
    for (i, (format, file)) in gltf.chain(others).enumerate() {
        std::fs::write(
            folder.join(format!("seed-{i}")),
            [vec![format], file].concat(),
        )?;
    }
    Ok(())
}
