//! Writes the seed files of the fuzzers into `corpus/loaders` and `corpus/surfaces`.

#[path = "../crates/formats/tests/common/mod.rs"]
mod common;
#[path = "../crates/subsurface/tests/read_support/files.rs"]
#[allow(dead_code)]
mod files;
#[path = "../crates/subsurface/tests/read_support/roff.rs"]
#[allow(dead_code)]
mod roff;

use std::path::Path;

fn main() -> std::io::Result<()> {
    loaders()?;
    surfaces()
}

fn loaders() -> std::io::Result<()> {
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
        (4, common::CITY.as_bytes().to_vec()),
        (4, common::CITY.replace('}', "}\n").into_bytes()),
        (
            4,
            br#"{"type":"CityJSON","version":"1.0","CityObjects":{"r":{"type":"Road","geometry":[{"type":"CompositeSolid","lod":2.5,"boundaries":[[[[[0,1,2]],[[0,2,3]]],[[[0,1,3,2,1]]]]],"semantics":{"surfaces":[{"type":"Door"}],"values":[[[0,null],null]]}},{"type":"GeometryInstance","template":0,"boundaries":[0],"transformationMatrix":[]}]},"g":{"type":"CityObjectGroup","children":["r"]}},"vertices":[[0,0,0],[1.5,0,0],[0,1,0],[0,0,1]]}"#.to_vec(),
        ),
    ];
    let gltf = gltf.into_iter().map(|file| (0, file));
    write(&folder, gltf.chain(others))
}

fn surfaces() -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus/surfaces");
    std::fs::create_dir_all(&folder)?;
    let grid = |way| {
        let grid = roff::GridFile {
            way,
            ..roff::GridFile::new([2, 2, 1])
        };
        grid.write(|_, [.., k]| -1500.0 - f64::from(k) * 10.0)
    };
    let values = [0.1, 0.2, 0.3, 0.4];
    let picks = "x,y,z,surface\n0,0,-5,a\n10,0,-6,a\n0,10,-7,a\n10,10,-4,a\n";
    let seeds = [
        (0, files::irap(4, 3, &files::depths(), 0.0)),
        (1, files::irap_ascii().into_bytes()),
        (2, grid(roff::Way::Little)),
        (2, grid(roff::Way::Ascii)),
        (
            2,
            roff::parameter(roff::Way::Big, [2, 2, 1], "float", &values),
        ),
        (3, files::gocad().into_bytes()),
        (4, files::faultroom().into_bytes()),
        (5, picks.as_bytes().to_vec()),
        (6, files::esri().into_bytes()),
        (7, files::geotiff(&[])),
    ];
    write(&folder, seeds.into_iter())
}

/// Writes each file after the byte that selects its format.
fn write(folder: &Path, files: impl Iterator<Item = (u8, Vec<u8>)>) -> std::io::Result<()> {
    for (i, (format, file)) in files.enumerate() {
        std::fs::write(
            folder.join(format!("seed-{i}")),
            [vec![format], file].concat(),
        )?;
    }
    Ok(())
}
