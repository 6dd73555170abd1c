//! Writes the seed files of the fuzzers into a folder each of `corpus`.

#[path = "../crates/formats/tests/common/mod.rs"]
mod common;
#[path = "../crates/subsurface/tests/read_support/eclipse.rs"]
#[allow(dead_code)]
mod eclipse;
#[path = "../crates/subsurface/tests/read_support/files.rs"]
#[allow(dead_code)]
mod files;
#[path = "../crates/subsurface/tests/read_support/roff.rs"]
#[allow(dead_code)]
mod roff;
#[path = "../crates/subsurface/tests/read_support/segy.rs"]
#[allow(dead_code)]
mod segy;

use std::path::{Path, PathBuf};

// Under the flags of coverage, every program needs libFuzzer's counters.
use libfuzzer_sys as _;

use antumbra_scene::Raster;
use antumbra_subsurface::{BrickSource, SubsurfaceError, VolumeLayout, write_volume};
use antumbra_terrain::{Field, PreparedScene, RasterDetail, Sectors, Terrain, TerrainOptions};
use glam::{DVec2, DVec3};

fn main() -> std::io::Result<()> {
    loaders()?;
    surfaces()?;
    rasters()?;
    grids()?;
    segys()?;
    volumes()?;
    horizons()?;
    words()
}

/// A folder of seeds.
fn folder(name: &str) -> std::io::Result<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = root.join("corpus").join(name);
    std::fs::create_dir_all(&folder)?;
    Ok(folder)
}

/// An `.npy` array in an archive without compression: its local header, its directory and its end.
fn npz(kind: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}\n");
    let mut array = b"\x93NUMPY\x01\x00".to_vec();
    array.extend((header.len() as u16).to_le_bytes());
    array.extend(header.as_bytes());
    array.extend(data);
    let length = (array.len() as u32).to_le_bytes();
    let crc = crc32(&array).to_le_bytes();
    let mut entry = vec![20, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    entry.extend(
        crc.into_iter()
            .chain(length)
            .chain(length)
            .chain([5, 0, 0, 0]),
    );
    let local = [&b"PK\x03\x04"[..], &entry, b"z.npy", &array].concat();
    let directory = [&b"PK\x01\x02\x14\x00"[..], &entry, &[0; 14], b"z.npy"].concat();
    let mut end = b"PK\x05\x06\0\0\0\0\x01\0\x01\0".to_vec();
    end.extend((directory.len() as u32).to_le_bytes());
    end.extend((local.len() as u32).to_le_bytes());
    end.extend([0, 0]);
    [local, directory, end].concat()
}

fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 * (crc & 1))
        })
    };
    !bytes.iter().fold(u32::MAX, step)
}

fn rasters() -> std::io::Result<()> {
    let seeds = [
        (0, npz("<f4", "(3, 4)", &[0; 48])),
        (0, npz("|u1", "(2, 2)", &[1, 2, 3, 4])),
        (1, files::esri().into_bytes()),
        (2, files::geotiff(&[])),
        (
            2,
            files::geotiff(&[1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9003]),
        ),
        (3, b"DSAA\n2 2\n0 1\n0 1\n1 4\n1 2\n3 1.70141e38\n".to_vec()),
        (3, surfer_6()),
        (3, surfer_7()),
    ];
    write(&folder("rasters")?, seeds.into_iter())
}

fn surfer_6() -> Vec<u8> {
    let numbers = [0.0, 1.0, 0.0, 1.0, 1.0, 4.0_f64]
        .map(f64::to_le_bytes)
        .concat();
    let values = [1.0, 2.0, 3.0, 4.0_f32].map(f32::to_le_bytes).concat();
    [b"DSBB\x02\0\x02\0".to_vec(), numbers, values].concat()
}

fn surfer_7() -> Vec<u8> {
    let numbers = [0.0, 0.0, 1.0, 1.0, 1.0, 4.0, 0.0, 1e38_f64]
        .map(f64::to_le_bytes)
        .concat();
    let values = [1.0, 2.0, 3.0, 4.0_f64].map(f64::to_le_bytes).concat();
    let head = b"DSRB\x04\0\0\0\x01\0\0\0GRID\x48\0\0\0\x02\0\0\0\x02\0\0\0".to_vec();
    [head, numbers, b"DATA\x20\0\0\0".to_vec(), values].concat()
}

fn grids() -> std::io::Result<()> {
    let seeds = [
        (0, eclipse::text("FEET").into_bytes()),
        (
            0,
            b"SPECGRID\n1 1 1/\nCOORD\n24*1/\nZCORN\n8*2/\nPORO\n.1/\n".to_vec(),
        ),
        (1, eclipse::binary()),
        (1, [eclipse::binary(), eclipse::results()].concat()),
    ];
    write(&folder("grids")?, seeds.into_iter())
}

fn segys() -> std::io::Result<()> {
    let made = |format, revision, is_little| {
        let made = segy::Segy {
            revision,
            is_little,
            samples: 2,
            inlines: [1, 2, 1],
            crosslines: [1, 2, 1],
            ..segy::Segy::new(format)
        };
        made.write()
    };
    let seeds = [
        (0, made(1, 0, false)),
        (1, made(5, 1, false)),
        (0, made(3, 2, true)),
        (1, made(8, 2, false)),
    ];
    write(&folder("segy")?, seeds.into_iter())
}

/// A volume of one value.
struct Plain(VolumeLayout);

impl BrickSource for Plain {
    fn layout(&self) -> &VolumeLayout {
        &self.0
    }

    fn read(&self, _: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError> {
        samples.fill(7);
        Ok(())
    }
}

fn volumes() -> std::io::Result<()> {
    let folder = folder("volumes")?;
    for (name, brick) in [("seed-0", 4), ("seed-1", 1)] {
        let layout = VolumeLayout {
            size: [5, 4, 3],
            brick,
            origin: DVec3::ZERO,
            steps: [DVec3::X, DVec3::Y, DVec3::Z],
            range: [0.0, 1.0],
        };
        let written = write_volume(&folder.join(name), "seed", &Plain(layout), &mut |_, _| ());
        written.map_err(std::io::Error::other)?;
    }
    Ok(())
}

fn horizons() -> std::io::Result<()> {
    let folder = folder("horizons")?;
    let raster = Raster {
        columns: 5,
        rows: 5,
        origin: DVec2::ZERO,
        step_u: DVec2::X,
        step_v: DVec2::Y,
        elevation: (0..25).map(|i| (i * 7 % 5) as f32).collect(),
    };
    let made = || {
        let field = Field::from_raster(&raster, RasterDetail::Vertices(25))?;
        let options = TerrainOptions {
            sectors: Sectors::new(4, 1)?,
            ..TerrainOptions::default()
        };
        let terrain = Terrain::prepare(field, &options, &|| ())?;
        let made = PreparedScene::from_terrain(terrain, "seed")?;
        made.terrain
            .save(&made.scene, &made.shown, &folder.join("seed-0"))
    };
    made().map_err(std::io::Error::other)
}

fn words() -> std::io::Result<()> {
    let path = r#"{"projection":{"perspective":{"fov_y_degrees":45,"near":0.1}},"poses":[{"eye":[0,0,9],"target":[0,0,0],"up":[0,1,0],"cut":true},{"eye":[0,0,9],"rotation":[0,0,0,1]}]}"#;
    let seeds = [
        (0, path),
        (1, "three-pass:threshold=50:latency=on-gpu"),
        (1, "depth-pyramid:phases=2"),
        (2, "wrong_pixels=0.02%"),
        (2, "frame_time=16ms"),
        (3, "false_culls=3"),
        (4, "4GiB"),
    ];
    let seeds = seeds.map(|(pick, text)| (pick, text.as_bytes().to_vec()));
    write(&folder("words")?, seeds.into_iter())
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
        (
            8,
            b"@a, GRID, 2\n9, -999, , 1, 1\n2, 2, 0, 1, 0, 1\n0, 0, 0\n@\n1 2\n3 -999\n".to_vec(),
        ),
        (
            9,
            b"FSASCI 0 1 C 0 1E30\nFSLIMI 0 1 0 1 0 9\nFSNROW 2 2\n->a\n1 2 3 4\n".to_vec(),
        ),
        (
            10,
            b"@x\n1 1 0 0 5\n1 2 0 9 6\n2 1 9 0 7\n2 2 9 9 7\nEOB".to_vec(),
        ),
        (11, b"0 0 1\n1 0 2\n0 1 3\n1,1;4\n".to_vec()),
        (12, b"DSAA\n2 2\n0 1\n0 1\n1 4\n1 2\n3 4\n".to_vec()),
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
