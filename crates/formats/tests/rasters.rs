//! Rasters from NumPy archives. The readers of Esri grids and GeoTIFFs are tested in the crate subsurface.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::io::{Cursor, Write};

use antumbra_formats::{RasterError, RasterFormat, load_raster_slice};
use antumbra_scene::Raster;
use glam::DVec2;
use proptest::prelude::*;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// An array in NumPy's format.
fn npy(kind: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header =
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}          \n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    bytes
}

fn number(value: f64) -> Vec<u8> {
    npy("<f8", "()", &value.to_le_bytes())
}

fn numbers(values: &[f32]) -> Vec<u8> {
    let data: Vec<u8> = values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect();
    npy("<f4", &format!("({},)", values.len()), &data)
}

fn heights(rows: usize, columns: usize) -> Vec<u8> {
    let data: Vec<u8> = (0..(rows * columns) as i16)
        .flat_map(i16::to_le_bytes)
        .collect();
    npy("<i2", &format!("({rows}, {columns})"), &data)
}

fn npz(arrays: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays {
        let name = format!("{name}.npy");
        archive
            .start_file(name, SimpleFileOptions::default())
            .unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

fn read(arrays: &[(&str, Vec<u8>)]) -> Result<Raster, String> {
    load_raster_slice(RasterFormat::Npz, &npz(arrays)).map_err(|error| error.to_string())
}

#[test]
fn a_bare_array_has_cells_of_a_metre() {
    let raster = read(&[("arr_0", heights(3, 4))]).unwrap();
    assert_eq!((raster.columns, raster.rows), (4, 3));
    assert_eq!(raster.elevation_at(1, 2), Some(9.0));
    assert_eq!(raster.plan_position(0, 0), DVec2::new(0.0, 2.0));
    assert_eq!(raster.plan_position(3, 2), DVec2::new(3.0, 0.0));
    assert_eq!(raster.elevation_at(4, 0), None);
}

#[test]
fn numbers_beside_it_say_where_it_lies() {
    let metres = read(&[
        ("elevation", heights(3, 4)),
        ("dx", number(30.0)),
        ("dy", number(20.0)),
        ("xmin", number(500_000.0)),
        ("ymax", number(4_000_040.0)),
    ]);
    let metres = metres.unwrap();
    assert_eq!(
        metres.plan_position(0, 0),
        DVec2::new(500_000.0, 4_000_040.0)
    );
    assert_eq!(
        metres.plan_position(3, 2),
        DVec2::new(500_090.0, 4_000_000.0)
    );

    let degrees = read(&[
        ("topo", heights(3, 3)),
        ("longitude", numbers(&[10.0, 10.5, 11.0])),
        ("latitude", numbers(&[61.0, 60.0, 59.0])),
    ]);
    let degrees = degrees.unwrap();
    let kilometres = 111_195.08;
    assert!((degrees.step_v + DVec2::Y * kilometres).length() < 1.0);
    assert!((degrees.step_u - DVec2::X * kilometres * 0.25).length() < 1.0);
}

#[test]
fn archives_that_lie_are_refused_with_what_is_wrong() {
    let refused = |arrays: &[(&str, Vec<u8>)], word: &str| {
        let error = read(arrays).unwrap_err();
        assert!(error.contains(word), "{error}");
    };
    refused(&[], "two dimensions");
    refused(&[("a", number(1.0))], "two dimensions");
    refused(&[("a", heights(2, 2)), ("b", heights(2, 2))], "several");
    refused(&[("a", npy("<i2", "(3, 4)", &[0; 4]))], "no array");
    refused(
        &[("a", npy("<i2", "(9999999999, 9999999999)", &[0; 4]))],
        "no array",
    );
    refused(&[("a", npy("|O", "(2, 2)", &[0; 4]))], "type");
    refused(&[("a", npy("<i2", "(2, x)", &[0; 8]))], "no size");
    refused(&[("a", npy("<i2", "(1, 4)", &[0; 8]))], "at least 2 x 2");
    refused(&[("a", b"\x93NUMPY\x01\x00\xff\xff".to_vec())], "cut off");
    refused(&[("a", vec![1; 40])], "NumPy");
    let column_first = String::from_utf8_lossy(&heights(2, 2)).replace("False", "True ");
    refused(
        &[("a", npy("<i2", "(2, 2)", column_first.as_bytes()))],
        "no array",
    );
    let whole = npz(&[("a", heights(30, 30))]);
    for end in [0, 1, whole.len() / 2, whole.len() - 1] {
        let cut = load_raster_slice(RasterFormat::Npz, &whole[..end]);
        assert!(matches!(cut, Err(RasterError::Format { .. })));
    }
}

proptest! {
    #[test]
    fn damaged_archives_are_read_or_refused(at in 0_usize..2000, byte: u8) {
        let mut bytes = npz(&[("elevation", heights(12, 12)), ("dx", number(3.0))]);
        let length = bytes.len();
        bytes[at % length] = byte;
        if let Ok(raster) = load_raster_slice(RasterFormat::Npz, &bytes) {
            prop_assert_eq!(raster.elevation.len(), raster.columns as usize * raster.rows as usize);
        }
    }
}
