//! Units of rasters: degrees, feet, scales and offsets all end as metres, alike in every format, and what was assumed is said.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::io::{Cursor, Write};

use antumbra_formats::raster::units_beside;
use antumbra_formats::{
    LoadedRaster, RasterFormat, RasterOptions, load_raster_slice_with, load_raster_with,
};
use glam::DVec2;
use tiff::encoder::TiffEncoder;
use tiff::encoder::colortype::{Gray16, Gray32Float};
use tiff::tags::Tag;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

const COLUMNS: u32 = 5;
const ROWS: u32 = 4;
const STEP: f64 = 1.0 / 1200.0;
/// The first node, in the north-west.
const WEST: f64 = 8.0;
const NORTH: f64 = 46.5;

/// A hill of some 300 m.
fn heights() -> Vec<f32> {
    let height = |at: u32| 100.0 + 37.0 * (at % COLUMNS * (at / COLUMNS)) as f32;
    (0..COLUMNS * ROWS).map(height).collect()
}

fn esri() -> Vec<u8> {
    let values: Vec<String> = heights().iter().map(f32::to_string).collect();
    let south = NORTH - STEP * f64::from(ROWS - 1);
    let text = format!(
        "ncols {COLUMNS}\nnrows {ROWS}\nxllcenter {WEST}\nyllcenter {south}\ncellsize {STEP}\nNODATA_value -9999\n{}\n",
        values.join(" ")
    );
    text.into_bytes()
}

/// A number or a text of GeoTIFF's.
struct Keys {
    keys: Vec<[u16; 4]>,
    doubles: Vec<f64>,
    metadata: &'static str,
}

impl Keys {
    const NONE: Self = Self {
        keys: Vec::new(),
        doubles: Vec::new(),
        metadata: "",
    };

    fn shorts(keys: &[(u16, u16)]) -> Self {
        Self {
            keys: keys
                .iter()
                .map(|&(key, value)| [key, 0, 1, value])
                .collect(),
            ..Self::NONE
        }
    }
}

fn geotiff(step: f64, corner: DVec2, keys: &Keys) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut file).unwrap();
    let mut image = encoder.new_image::<Gray32Float>(COLUMNS, ROWS).unwrap();
    let tags = image.encoder();
    let scale = [step, step, 0.0];
    tags.write_tag(Tag::ModelPixelScaleTag, &scale[..]).unwrap();
    // Pixels are areas: the corner lies half a pixel from the first node.
    let tie = [
        0.0,
        0.0,
        0.0,
        corner.x - step / 2.0,
        corner.y + step / 2.0,
        0.0,
    ];
    tags.write_tag(Tag::ModelTiepointTag, &tie[..]).unwrap();
    if !keys.keys.is_empty() {
        let head = [1, 1, 0, keys.keys.len() as u16];
        let all: Vec<u16> = [head].iter().chain(&keys.keys).flatten().copied().collect();
        tags.write_tag(Tag::GeoKeyDirectoryTag, &all[..]).unwrap();
    }
    if !keys.doubles.is_empty() {
        tags.write_tag(Tag::GeoDoubleParamsTag, &keys.doubles[..])
            .unwrap();
    }
    if !keys.metadata.is_empty() {
        tags.write_tag(Tag::Unknown(42112), keys.metadata).unwrap();
    }
    image.write_data(&heights()).unwrap();
    file.into_inner()
}

fn npy(shape: &str, kind: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}\n");
    let length = (header.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), data].concat()
}

fn npz() -> Vec<u8> {
    npz_with(&[])
}

/// With further arrays.
fn npz_with(further: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let data: Vec<u8> = heights().iter().flat_map(|h| h.to_le_bytes()).collect();
    let number = |value: f64| npy("()", "<f8", &value.to_le_bytes());
    let south = NORTH - STEP * f64::from(ROWS - 1);
    let arrays = [
        (
            "elevation",
            npy(&format!("({ROWS}, {COLUMNS})"), "<f4", &data),
        ),
        ("dx", number(STEP)),
        ("dy", number(STEP)),
        ("xmin", number(WEST)),
        ("ymin", number(south)),
    ];
    let further = further.iter().map(|(name, bytes)| (*name, bytes.clone()));
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays.into_iter().chain(further) {
        let options = SimpleFileOptions::default();
        archive.start_file(format!("{name}.npy"), options).unwrap();
        archive.write_all(&bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

fn surfer() -> Vec<u8> {
    // Rows from the south.
    let all = heights();
    let rows = all.chunks(COLUMNS as usize).rev().flatten();
    let values: Vec<String> = rows.map(f32::to_string).collect();
    let east = WEST + STEP * f64::from(COLUMNS - 1);
    let south = NORTH - STEP * f64::from(ROWS - 1);
    let text = format!(
        "DSAA\n{COLUMNS} {ROWS}\n{WEST} {east}\n{south} {NORTH}\n0 1\n{}\n",
        values.join(" ")
    );
    text.into_bytes()
}

fn read_with(format: RasterFormat, bytes: &[u8], units: &str) -> LoadedRaster {
    let options = RasterOptions {
        units: match units {
            "" => Default::default(),
            units => units.parse().unwrap(),
        },
        ..RasterOptions::default()
    };
    load_raster_slice_with(format, bytes, &options).unwrap()
}

fn read(format: RasterFormat, bytes: &[u8]) -> LoadedRaster {
    read_with(format, bytes, "")
}

fn says(loaded: &LoadedRaster, word: &str) {
    let said = loaded.notes.iter().any(|note| note.contains(word));
    assert!(said, "no note says `{word}`: {:?}", loaded.notes);
}

/// The steps of a hill of sane proportions: a 1200th of a degree at 46.5 degrees north.
fn is_hill(loaded: &LoadedRaster) {
    let raster = &loaded.raster;
    let (east, north) = (raster.step_u.length(), raster.step_v.length());
    assert!((north - 92.66).abs() < 0.01, "{north}");
    assert!((east - 63.78).abs() < 0.05, "{east}");
    says(loaded, "taken to metres about latitude 46.49");
}

fn same(a: &LoadedRaster, b: &LoadedRaster) {
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            // Surfer's rows begin in the south.
            let flipped = |raster: &antumbra_scene::Raster| match raster.step_v.y > 0.0 {
                true => ROWS - 1 - row,
                false => row,
            };
            let at = |loaded: &LoadedRaster| {
                let row = flipped(&loaded.raster);
                loaded.raster.position(column, row).unwrap()
            };
            assert!(at(a).distance(at(b)) < 1e-3, "{} {}", at(a), at(b));
        }
    }
}

#[test]
fn degrees_are_metres_alike_in_every_format() {
    let corner = DVec2::new(WEST, NORTH);
    let epsg4326 = Keys::shorts(&[(1024, 2), (1025, 1), (2048, 4326)]);
    let all = [
        read(RasterFormat::Esri, &esri()),
        read(RasterFormat::GeoTiff, &geotiff(STEP, corner, &Keys::NONE)),
        read(RasterFormat::GeoTiff, &geotiff(STEP, corner, &epsg4326)),
        read(RasterFormat::Npz, &npz()),
        read(RasterFormat::Surfer, &surfer()),
    ];
    for loaded in &all {
        is_hill(loaded);
        same(loaded, &all[0]);
    }
    // The file that says so is not said to have been guessed.
    assert!(
        !all[2]
            .notes
            .iter()
            .any(|note| note.contains("no unit, and"))
    );
    says(&all[0], "can only be degrees");
}

#[test]
fn a_latitude_among_the_arrays_alone_makes_no_degrees() {
    // The latitude of an origin, beside positions by their step.
    let origin = npy("()", "<f8", &46.5_f64.to_le_bytes());
    let loaded = read(RasterFormat::Npz, &npz_with(&[("lat", origin)]));
    says(&loaded, "can only be degrees");
    // Positions of all columns and rows are what they are called.
    let all = |count: u32, from: f64, step: f64| {
        let values = (0..count).flat_map(|at| (from + step * f64::from(at)).to_le_bytes());
        npy(&format!("({count},)"), "<f8", &values.collect::<Vec<_>>())
    };
    let placed = npz_with(&[
        ("lon", all(COLUMNS, WEST, STEP)),
        ("lat", all(ROWS, NORTH, -STEP)),
    ]);
    let loaded = read(RasterFormat::Npz, &placed);
    is_hill(&loaded);
    says(&loaded, "its places are degrees");
    let mixed = npz_with(&[
        ("lon", all(COLUMNS, 0.0, 30.0)),
        ("y", all(ROWS, 0.0, -30.0)),
    ]);
    let loaded = read(RasterFormat::Npz, &mixed);
    assert_eq!(loaded.raster.step_u, DVec2::new(30.0, 0.0));
}

#[test]
fn a_caller_overrides_what_was_guessed_or_said() {
    let metres = read_with(RasterFormat::Esri, &esri(), "m");
    assert!((metres.raster.step_u.x - STEP).abs() < 1e-12);
    assert!(metres.notes.is_empty(), "{:?}", metres.notes);
    let keys = Keys::shorts(&[(1024, 2)]);
    let tiff = geotiff(STEP, DVec2::new(WEST, NORTH), &keys);
    let metres = read_with(RasterFormat::GeoTiff, &tiff, "m");
    assert!((metres.raster.step_u.x - STEP).abs() < 1e-12);
    let feet = read_with(RasterFormat::Esri, &esri(), "degrees,ft");
    let height = feet.raster.elevation_at(0, 0).unwrap();
    assert!((height - 30.48).abs() < 1e-4, "{height}");
}

#[test]
fn a_small_grid_of_metres_stays_one() {
    let text = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 50 100 3 4 5\n";
    let loaded = read(RasterFormat::Esri, text.as_bytes());
    assert_eq!(loaded.raster.step_u, DVec2::new(1.0, 0.0));
    says(&loaded, "names no unit: taken as metres");
}

#[test]
fn linear_and_vertical_units_of_a_geotiff_are_applied() {
    let corner = DVec2::new(600_000.0, 4_000_000.0);
    let survey_feet = Keys::shorts(&[(1024, 1), (3076, 9003), (4099, 9002)]);
    let loaded = read(RasterFormat::GeoTiff, &geotiff(30.0, corner, &survey_feet));
    let foot = 1200.0 / 3937.0;
    assert!((loaded.raster.step_u.x - 30.0 * foot).abs() < 1e-9);
    assert!((loaded.raster.origin.x - 600_000.0 * foot).abs() < 1e-6);
    assert!((loaded.raster.elevation_at(0, 0).unwrap() - 30.48).abs() < 1e-4);
    says(&loaded, "places are US survey feet");
    says(&loaded, "heights are feet");

    let own = Keys {
        keys: vec![[1024, 0, 1, 1], [3076, 0, 1, 32767], [3077, 34736, 1, 1]],
        doubles: vec![7.0, 0.5],
        metadata: "",
    };
    let loaded = read(RasterFormat::GeoTiff, &geotiff(30.0, corner, &own));
    assert!((loaded.raster.step_u.x - 15.0).abs() < 1e-9);
    says(&loaded, "places are units of 0.5 m");
    assert!(!loaded.notes.iter().any(|note| note.contains("not known")));

    let unknown = Keys::shorts(&[(1024, 1), (3076, 9098), (4099, 9097)]);
    let loaded = read(RasterFormat::GeoTiff, &geotiff(30.0, corner, &unknown));
    says(&loaded, "unit of places, `EPSG:9098`, is not known");
    says(&loaded, "unit of heights, `EPSG:9097`, is not known");

    let code = Keys::shorts(&[(1024, 1), (3072, 2263)]);
    let loaded = read(RasterFormat::GeoTiff, &geotiff(30.0, corner, &code));
    says(&loaded, "EPSG:2263");
}

#[test]
fn scale_and_offset_of_a_band_are_applied() {
    let corner = DVec2::new(500_000.0, 4_000_000.0);
    let keys = Keys {
        metadata: "<GDALMetadata>\n  <Item name=\"OFFSET\" sample=\"0\" role=\"offset\">100</Item>\n  \
                   <Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.5</Item>\n  \
                   <Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">ft</Item>\n</GDALMetadata>",
        ..Keys::shorts(&[(1024, 1), (3076, 9001)])
    };
    let loaded = read(RasterFormat::GeoTiff, &geotiff(30.0, corner, &keys));
    let expected = (100.0 * 0.5 + 100.0) * 0.3048;
    assert!((loaded.raster.elevation_at(0, 0).unwrap() - expected).abs() < 1e-3);
    says(&loaded, "times 0.5 plus 100");
    let cubits = Keys {
        metadata: "<Item role=\"unittype\">cubits</Item>",
        ..Keys::NONE
    };
    let loaded = read(RasterFormat::GeoTiff, &geotiff(30.0, corner, &cubits));
    says(&loaded, "`cubits`");
    for broken in [
        "<Item role=\"scale\"",
        "<Item role=\"scale\">nan</Item>",
        "<Item>",
    ] {
        let keys = Keys {
            metadata: broken,
            ..Keys::NONE
        };
        let loaded = read(RasterFormat::GeoTiff, &geotiff(30.0, corner, &keys));
        assert_eq!(loaded.raster.elevation_at(0, 0), Some(100.0));
    }
}

#[test]
fn a_projection_file_beside_a_raster_names_its_units() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("dem.asc");
    let text = "ncols 2\nnrows 2\nxllcenter 1000\nyllcenter 2000\ncellsize 10\n1 2 3 4\n";
    std::fs::write(&file, text).unwrap();
    let projection =
        r#"PROJCS["x",GEOGCS["y",UNIT["degree",0.0174532925199433]],UNIT["foot",0.3048]]"#;
    std::fs::write(folder.path().join("dem.prj"), projection).unwrap();
    let loaded = load_raster_with(&file, &RasterOptions::default()).unwrap();
    assert!((loaded.raster.step_u.x - 3.048).abs() < 1e-9);
    says(&loaded, "places are feet");
    // In memory the same, where the caller asks for it.
    let options = RasterOptions {
        beside: units_beside(&file),
        ..RasterOptions::default()
    };
    let in_memory = load_raster_slice_with(RasterFormat::Esri, text.as_bytes(), &options);
    assert_eq!(in_memory.unwrap(), loaded);
}

#[test]
fn rasters_beside_each_other_share_a_latitude() {
    let options = |latitude| RasterOptions {
        latitude,
        ..RasterOptions::default()
    };
    let load = |bytes: &[u8], latitude| {
        let options = options(latitude);
        load_raster_slice_with(RasterFormat::Esri, bytes, &options).unwrap()
    };
    let here = load(&esri(), None);
    let text = String::from_utf8(esri()).unwrap();
    let beside = text.replace(
        &format!("xllcenter {WEST}"),
        &format!("xllcenter {}", WEST + STEP * f64::from(COLUMNS)),
    );
    let beside = load(beside.as_bytes(), here.latitude);
    let gap = beside.raster.plan_position(0, 0).x - here.raster.plan_position(COLUMNS - 1, 0).x;
    assert!((gap - here.raster.step_u.x).abs() < 1e-6);
}

#[test]
fn degrees_on_no_globe_are_refused() {
    let keys = Keys::shorts(&[(1024, 2)]);
    let bytes = geotiff(30.0, DVec2::new(500_000.0, 4_000_000.0), &keys);
    let error = load_raster_slice_with(RasterFormat::GeoTiff, &bytes, &RasterOptions::default());
    assert!(error.unwrap_err().to_string().contains("--units m"));
    let geocentric = Keys::shorts(&[(1024, 3)]);
    let bytes = geotiff(30.0, DVec2::ZERO, &geocentric);
    let error = load_raster_slice_with(RasterFormat::GeoTiff, &bytes, &RasterOptions::default());
    assert!(error.unwrap_err().to_string().contains("geocentric"));
}

#[cfg(feature = "zstd")]
#[test]
fn zstd_is_read() {
    // A frame of one segment with its size, and a last block that is not packed (RFC 8878).
    let values: Vec<u8> = (0..12_u16).flat_map(|v| (v * 10).to_le_bytes()).collect();
    let size = values.len() as u8;
    let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd, 0x20, size, size << 3 | 1, 0, 0];
    frame.extend(values);
    let mut file = Cursor::new(Vec::new());
    {
        let mut encoder = TiffEncoder::new(&mut file).unwrap();
        let mut image = encoder.image_directory().unwrap();
        for (tag, value) in [(256, 4_u32), (257, 3), (278, 3)] {
            image.write_tag(Tag::Unknown(tag), value).unwrap();
        }
        for (tag, value) in [(258, 16_u16), (259, 50_000), (262, 1), (277, 1), (339, 1)] {
            image.write_tag(Tag::Unknown(tag), value).unwrap();
        }
        let at = image.write_data(frame.as_slice()).unwrap();
        image.write_tag(Tag::StripOffsets, at as u32).unwrap();
        let length = frame.len() as u32;
        image.write_tag(Tag::StripByteCounts, length).unwrap();
        let scale = [10.0, 10.0, 0.0];
        image
            .write_tag(Tag::ModelPixelScaleTag, &scale[..])
            .unwrap();
        let tie = [0.0, 0.0, 0.0, 5000.0, 9000.0, 0.0];
        image.write_tag(Tag::ModelTiepointTag, &tie[..]).unwrap();
        image.finish().unwrap();
    }
    let loaded = read(RasterFormat::GeoTiff, &file.into_inner());
    assert_eq!(loaded.raster.elevation_at(3, 2), Some(110.0));
}

#[test]
fn integers_keep_their_values() {
    let mut file = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut file).unwrap();
    let mut image = encoder.new_image::<Gray16>(2, 2).unwrap();
    let tags = image.encoder();
    tags.write_tag(Tag::ModelPixelScaleTag, &[10.0, 10.0, 0.0][..])
        .unwrap();
    tags.write_tag(Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, 5e5, 4e6, 0.0][..])
        .unwrap();
    tags.write_tag(Tag::GdalNodata, "7").unwrap();
    image.write_data(&[1, 7, 3, 65_535]).unwrap();
    let loaded = read(RasterFormat::GeoTiff, &file.into_inner());
    let at = |column, row| loaded.raster.elevation_at(column, row);
    assert_eq!(
        [at(0, 0), at(1, 0), at(1, 1)],
        [Some(1.0), None, Some(65_535.0)]
    );
}
