//! GeoTIFF rasters with one band of heights and tags for their position.

use std::io::Cursor;

use glam::DVec2;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

use super::text::{node_count, parse_number};
use antumbra_files::MemoryBudget;
use antumbra_files::words::shorten;
use antumbra_scene::Raster;

/// The greatest number of bytes of a decoded raster, and the greatest ratio to the compressed bytes.
const MAX_BYTES: usize = 1 << 30;
const MAX_PACKED: usize = 4096;

/// Bytes of a decoded post, at most.
const DECODED: u64 = 8;

/// Keys in GeoTIFF's own directory, and their values.
const MODEL_TYPE: u16 = 1024;
const GEOGRAPHIC: u16 = 2;
const RASTER_TYPE: u16 = 1025;
const PIXEL_IS_POINT: u16 = 2;

pub(super) fn read(bytes: &[u8], memory: &mut MemoryBudget) -> Result<Raster, String> {
    // The crate quotes what it finds, however long it is.
    let text = |error: tiff::TiffError| shorten(&error.to_string(), 300);
    super::tiff_directory::take(bytes, memory)?;
    let mut limits = Limits::default();
    let largest = usize::try_from(memory.left())
        .unwrap_or(usize::MAX)
        .min(MAX_BYTES);
    limits.decoding_buffer_size = largest;
    limits.intermediate_buffer_size = largest;
    limits.ifd_value_size = largest.min(limits.ifd_value_size);
    let mut file = Decoder::new(Cursor::new(bytes))
        .map_err(text)?
        .with_limits(limits);
    let (columns, rows) = file.dimensions().map_err(text)?;
    let most = bytes.len().saturating_mul(MAX_PACKED).min(MAX_BYTES);
    let nodes = node_count(columns, rows, most)?;
    let samples = file.find_tag_unsigned::<u16>(Tag::SamplesPerPixel);
    let bands = samples.map_err(text)?.unwrap_or(1);
    if bands != 1 {
        return Err(format!("it has {bands} bands; give one of heights alone"));
    }
    // Each post is decoded to at most eight bytes.
    super::take_posts(memory, columns, rows, DECODED)?;
    let placed = Placed::of(&mut file)?;
    let nodata = file.get_tag_ascii_string(Tag::GdalNodata).ok();
    let nodata = nodata.and_then(|text| parse_number(text.trim_matches(['\0', ' '])));
    // Compared as f32, since the tag is text with any number of digits.
    let nodata = nodata.map(|value| value as f32);
    let height = |value: f64| match nodata == Some(value as f32) {
        true => f32::NAN,
        false => value as f32,
    };
    let elevation = heights(file.read_image().map_err(text)?, height);
    if elevation.len() != nodes {
        return Err(format!(
            "{columns} x {rows} values are declared, but {} are there",
            elevation.len()
        ));
    }
    Ok(Raster {
        columns,
        rows,
        origin: placed.origin,
        step_u: placed.step_u,
        step_v: placed.step_v,
        elevation,
    })
}

/// The position of the first pixel's node, and the steps to the next nodes.
struct Placed {
    origin: DVec2,
    step_u: DVec2,
    step_v: DVec2,
}

impl Placed {
    fn of(file: &mut Decoder<Cursor<&[u8]>>) -> Result<Self, String> {
        let keys = file.get_tag_u16_vec(Tag::GeoKeyDirectoryTag);
        let keys = keys.unwrap_or_default();
        let key = |wanted: u16| {
            let entries = keys.as_chunks::<4>().0.iter().skip(1);
            let mut found = entries.filter(|[id, location, ..]| *id == wanted && *location == 0);
            found.next().map(|[.., value]| *value)
        };
        if key(MODEL_TYPE) == Some(GEOGRAPHIC) {
            return Err("its places are degrees; project it to metres".into());
        }
        let mut numbers = |tag: Tag| file.get_tag_f64_vec(tag).unwrap_or_default();
        let (transform, scale, tie) = (
            numbers(Tag::ModelTransformationTag),
            numbers(Tag::ModelPixelScaleTag),
            numbers(Tag::ModelTiepointTag),
        );
        let (corner, step_u, step_v) =
            if let Some(&[a, b, _, d, e, f, _, h, ..]) = transform.first_chunk::<16>() {
                (DVec2::new(d, h), DVec2::new(a, e), DVec2::new(b, f))
            } else if let (Some(&[x, y, ..]), Some(&[column, row, _, east, north, _])) =
                (scale.first_chunk::<3>(), tie.first_chunk::<6>())
            {
                let (step_u, step_v) = (DVec2::new(x, 0.0), DVec2::new(0.0, -y));
                let corner = DVec2::new(east, north) - step_u * column - step_v * row;
                (corner, step_u, step_v)
            } else {
                return Err(
                "no tags say where it lies (a pixel scale and a tie point, or a transformation)"
                    .into(),
            );
            };
        // A pixel is an area with its height at the centre, unless the file declares it a point.
        let inset = if key(RASTER_TYPE) == Some(PIXEL_IS_POINT) {
            0.0
        } else {
            0.5
        };
        Ok(Self {
            origin: corner + (step_u + step_v) * inset,
            step_u,
            step_v,
        })
    }
}

fn heights(decoded: DecodingResult, height: impl Fn(f64) -> f32) -> Vec<f32> {
    fn all<T: Into<f64>>(values: Vec<T>, height: impl Fn(f64) -> f32) -> Vec<f32> {
        let heights = values.into_iter().map(|value| height(value.into()));
        heights.collect()
    }
    match decoded {
        DecodingResult::U8(values) => all(values, height),
        DecodingResult::U16(values) => all(values, height),
        DecodingResult::U32(values) => all(values, height),
        DecodingResult::I8(values) => all(values, height),
        DecodingResult::I16(values) => all(values, height),
        DecodingResult::I32(values) => all(values, height),
        DecodingResult::F16(values) => all(values, height),
        DecodingResult::F32(values) => all(values, height),
        DecodingResult::F64(values) => all(values, height),
        DecodingResult::U64(values) => values.into_iter().map(|v| height(v as f64)).collect(),
        DecodingResult::I64(values) => values.into_iter().map(|v| height(v as f64)).collect(),
    }
}
