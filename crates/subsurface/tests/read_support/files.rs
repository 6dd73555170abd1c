//! Small valid files of every format, written from the descriptions of the formats.

use std::io::Cursor;

use tiff::encoder::{TiffEncoder, colortype::Gray32Float};
use tiff::tags::Tag;

/// Origin of the small rasters: metres east and north, like that of a real field.
pub const WEST: f64 = 460_000.0;
pub const SOUTH: f64 = 5_930_000.0;

/// 4 columns and 3 rows, south row first; one is undefined.
pub fn depths() -> Vec<f32> {
    let depth = |index: usize| 1500.0 + index as f32;
    let mut depths: Vec<_> = (0..12).map(depth).collect();
    depths[5] = 9_999_900.0;
    depths
}

fn record(bytes: &[u8]) -> Vec<u8> {
    let length = (bytes.len() as i32).to_be_bytes();
    [&length[..], bytes, &length].concat()
}

/// Steps of 20 m east and 25 m north before the rotation.
pub fn irap(columns: i32, rows: i32, values: &[f32], degrees: f32) -> Vec<u8> {
    let floats = |values: &[f32]| {
        values
            .iter()
            .flat_map(|v| v.to_be_bytes())
            .collect::<Vec<_>>()
    };
    let (west, south) = (WEST as f32, SOUTH as f32);
    let east = west + 20.0 * (columns as f32 - 1.0);
    let north = south + 25.0 * (rows as f32 - 1.0);
    let head = [
        &(-996_i32).to_be_bytes()[..],
        &rows.to_be_bytes(),
        &floats(&[west, east, south, north, 20.0, 25.0]),
    ];
    let turn = [&columns.to_be_bytes()[..], &floats(&[degrees, west, south])];
    let mut file = record(&head.concat());
    file.extend(record(&turn.concat()));
    file.extend(record(&[0; 28]));
    for row in values.chunks(columns.max(1) as usize) {
        file.extend(record(&floats(row)));
    }
    file
}

pub fn irap_ascii() -> String {
    let values: Vec<_> = depths().iter().map(f32::to_string).collect();
    format!(
        "-996 3 20.0 25.0\n{WEST} {} {SOUTH} {}\n4 0.0 {WEST} {SOUTH}\n0 0 0 0 0 0 0\n{}\n",
        WEST + 60.0,
        SOUTH + 50.0,
        values.join(" ")
    )
}

/// The same field as elevations, north row first, 20 m along both axes.
pub fn esri() -> String {
    let rows: Vec<_> = (0..3)
        .rev()
        .map(|row| {
            let values = (0..4).map(|column| match row * 4 + column {
                5 => "-9999".to_owned(),
                index => format!("{}", -1500 - index),
            });
            values.collect::<Vec<_>>().join(" ")
        })
        .collect();
    format!(
        "ncols 4\nnrows 3\nxllcenter {WEST}\nyllcenter {SOUTH}\ncellsize 20\nNODATA_value -9999\n{}\n",
        rows.join("\n")
    )
}

/// The same as a GeoTIFF with one pixel around each node. `keys` is the GeoTIFF key directory.
pub fn geotiff(keys: &[u16]) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut file).unwrap();
    let mut image = encoder.new_image::<Gray32Float>(4, 3).unwrap();
    let tags = image.encoder();
    let tie = [0.0, 0.0, 0.0, WEST - 10.0, SOUTH + 50.0, 0.0];
    tags.write_tag(Tag::ModelPixelScaleTag, &[20.0, 20.0, 0.0][..])
        .unwrap();
    tags.write_tag(Tag::ModelTiepointTag, &tie[..]).unwrap();
    if !keys.is_empty() {
        tags.write_tag(Tag::GeoKeyDirectoryTag, keys).unwrap();
    }
    tags.write_tag(Tag::GdalNodata, "-9999").unwrap();
    let rows = (0..3)
        .rev()
        .flat_map(|row| (0..4).map(move |column| row * 4 + column));
    let heights: Vec<_> = rows
        .map(|at| {
            if at == 5 {
                -9999.0
            } else {
                -1500.0 - at as f32
            }
        })
        .collect();
    image.write_data(&heights).unwrap();
    file.into_inner()
}

/// Two objects: a bent pair of triangles, and one that shares its vertices by ATOM.
pub fn gocad() -> String {
    "GOCAD TSurf 1\nHEADER {\nname:F1\n}\nZPOSITIVE Depth\nTFACE\n\
     VRTX 1 460000 5930000 1500\nVRTX 2 460100 5930000 1500\nPVRTX 3 460000 5930100 1600 0.5\nVRTX 7 460100 5930100 1600\n\
     TRGL 1 2 3\nTRGL 3 2 7\nBSTONE 1\nEND\n\
     GOCAD TSurf 1\nHEADER { name:F2 }\nZPOSITIVE Elevation\nTFACE\n\
     VRTX 1 0 0 -10\nVRTX 2 10 0 -10\nVRTX 3 0 10 -20\nATOM 4 3\nTRGL 1 2 4\nEND\n"
        .into()
}

/// Two faults; the triangles of the first share an edge and have opposite windings.
pub fn faultroom() -> String {
    let feature = |fault: &str, corners: [[f64; 3]; 3]| {
        let ring = [corners[0], corners[1], corners[2], corners[0]];
        format!(
            r#"{{"type":"Feature","properties":{{"FaultID":"{fault}","TriangleID":0}},"geometry":{{"type":"Polygon","coordinates":[{ring:?}]}}}}"#
        )
    };
    let (a, b, c, d) = (
        [460_000.0, 5_930_000.0, 1500.0],
        [460_100.0, 5_930_000.0, 1500.0],
        [460_000.0, 5_930_100.0, 1600.0],
        [460_100.0, 5_930_100.0, 1600.0],
    );
    let features = [
        feature("F1", [a, b, c]),
        feature("F2", [a, c, d]),
        feature("F1", [b, c, d]),
    ];
    format!(
        r#"{{"type":"FeatureCollection","features":[{}]}}"#,
        features.join(",")
    )
}
