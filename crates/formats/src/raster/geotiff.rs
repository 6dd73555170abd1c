//! GeoTIFF rasters with one band of heights and tags for their position.

use std::io::Cursor;

use glam::DVec2;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

use super::frame::RawRaster;
use super::text::{node_count, parse_number};
use crate::units::{LengthUnit, PlanUnit, SaidUnits, Units};
use antumbra_files::MemoryBudget;
use antumbra_files::words::shorten;
use antumbra_scene::Raster;

/// The greatest number of bytes of a decoded raster, and the greatest ratio to the compressed bytes.
const MAX_BYTES: usize = 1 << 30;
const MAX_PACKED: usize = 4096;

/// Bytes of a decoded post, at most.
const DECODED: u64 = 8;

/// Keys in GeoTIFF's own directory (OGC 19-008), and their values.
const MODEL_TYPE: u16 = 1024;
const GEOGRAPHIC: u16 = 2;
const GEOCENTRIC: u16 = 3;
const RASTER_TYPE: u16 = 1025;
const PIXEL_IS_POINT: u16 = 2;
const ANGULAR_UNITS: u16 = 2054;
const PROJECTED_SYSTEM: u16 = 3072;
const LINEAR_UNITS: u16 = 3076;
const LINEAR_UNIT_SIZE: u16 = 3077;
const VERTICAL_SYSTEM: u16 = 4096;
const VERTICAL_UNITS: u16 = 4099;
/// The codes of units that are undefined, or of the file's own size.
const OWN_UNITS: [u16; 2] = [0, 32767];

/// GDAL's own tag of metadata: XML with an item for the scale, the offset and the unit of the band.
const GDAL_METADATA: Tag = Tag::Unknown(42112);

pub(super) fn read(bytes: &[u8], memory: &mut MemoryBudget) -> Result<RawRaster, String> {
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
    let keys = GeoKeys::of(&mut file);
    let placed = Placed::of(&mut file, &keys)?;
    let band = Band::of(&mut file);
    let nodata = file.get_tag_ascii_string(Tag::GdalNodata).ok();
    let nodata = nodata.and_then(|text| parse_number(text.trim_matches(['\0', ' '])));
    // Compared as f32, since the tag is text with any number of digits.
    let nodata = nodata.map(|value| value as f32);
    let height = |value: f64| match nodata == Some(value as f32) {
        true => f32::NAN,
        false => (value * band.scale + band.offset) as f32,
    };
    let elevation = heights(file.read_image().map_err(text)?, height);
    if elevation.len() != nodes {
        return Err(format!(
            "{columns} x {rows} values are declared, but {} are there",
            elevation.len()
        ));
    }
    let mut notes = Vec::new();
    if (band.scale, band.offset) != (1.0, 0.0) {
        notes.push(format!(
            "its values are taken times {} plus {}, as it says",
            band.scale, band.offset
        ));
    }
    let SaidUnits {
        units: said,
        notes: unknown,
    } = keys.units();
    notes.extend(unknown);
    let band_unit = || {
        let mut said = SaidUnits::default();
        let unit = said.length("heights", &band.unit);
        notes.extend(said.notes);
        unit
    };
    let height = said.height.or_else(band_unit);
    if let (None, Some(code)) = (said.plan, keys.short(PROJECTED_SYSTEM)) {
        notes.push(format!(
            "it names the projection EPSG:{code} and not its unit, which may be feet"
        ));
    }
    Ok(RawRaster {
        raster: Raster {
            columns,
            rows,
            origin: placed.origin,
            step_u: placed.step_u,
            step_v: placed.step_v,
            elevation,
        },
        said: Units { height, ..said },
        is_placed: true,
        notes,
    })
}

/// GeoTIFF's directory of keys: shorts, and indices of doubles.
struct GeoKeys {
    entries: Vec<[u16; 4]>,
    doubles: Vec<f64>,
}

impl GeoKeys {
    fn of(file: &mut Decoder<Cursor<&[u8]>>) -> Self {
        let entries = file.get_tag_u16_vec(Tag::GeoKeyDirectoryTag);
        let entries = entries.unwrap_or_default();
        Self {
            entries: entries.as_chunks::<4>().0.iter().skip(1).copied().collect(),
            doubles: file
                .get_tag_f64_vec(Tag::GeoDoubleParamsTag)
                .unwrap_or_default(),
        }
    }

    /// The value of a key that is a short.
    fn short(&self, wanted: u16) -> Option<u16> {
        let mut entries = self.entries.iter();
        let found = entries.find(|[id, location, ..]| *id == wanted && *location == 0);
        found.map(|[.., value]| *value)
    }

    /// The value of a key that is a double.
    fn double(&self, wanted: u16) -> Option<f64> {
        let mut entries = self.entries.iter();
        let [.., index] = entries.find(|[id, location, ..]| *id == wanted && *location != 0)?;
        self.doubles.get(usize::from(*index)).copied()
    }

    fn units(&self) -> SaidUnits {
        let mut said = SaidUnits::default();
        let code = |key| self.short(key).filter(|code| !OWN_UNITS.contains(code));
        let plan = if self.short(MODEL_TYPE) == Some(GEOGRAPHIC) {
            Some(PlanUnit::Angle(match code(ANGULAR_UNITS) {
                Some(9101) => 1_f64.to_degrees(),
                Some(9103) => 1.0 / 60.0,
                Some(9104) => 1.0 / 3600.0,
                Some(9105 | 9106) => 0.9,
                None | Some(9102 | 9122) => 1.0,
                Some(code) => {
                    said.notes.push(format!(
                        "its unit of angles, EPSG:{code}, is not known: taken as degrees (--units)"
                    ));
                    1.0
                }
            }))
        } else {
            let own = || LengthUnit::from_metres(self.double(LINEAR_UNIT_SIZE)?);
            let named = code(LINEAR_UNITS).filter(|code| {
                // A size says it too.
                LengthUnit::from_code(*code).is_some() || own().is_none()
            });
            let named = named.and_then(|code| said.length_of_code("places", code));
            named.or_else(own).map(PlanUnit::Length)
        };
        // Heights over NAVD 88 in US survey feet and in feet are systems of their own.
        let of_system = || match self.short(VERTICAL_SYSTEM)? {
            6360 => LengthUnit::from_code(9003),
            8228 => Some(LengthUnit::FOOT),
            _ => None,
        };
        let height = code(VERTICAL_UNITS).and_then(|code| said.length_of_code("heights", code));
        said.units = Units {
            plan,
            height: height.or_else(of_system),
        };
        said
    }
}

/// What GDAL's metadata say about the values: `value * scale + offset`, and the unit.
struct Band {
    scale: f64,
    offset: f64,
    /// Empty where it has none.
    unit: String,
}

impl Band {
    fn of(file: &mut Decoder<Cursor<&[u8]>>) -> Self {
        let text = file.get_tag_ascii_string(GDAL_METADATA).unwrap_or_default();
        let item = |role: &str| {
            let role = format!("role=\"{role}\"");
            let mut items = text.split("<Item").skip(1);
            let item = items.find_map(|item| {
                let (attributes, rest) = item.split_once('>')?;
                attributes.contains(&role).then_some(rest)
            })?;
            item.split('<').next().map(str::trim)
        };
        let number = |role: &str| {
            let number = item(role).and_then(parse_number);
            number.filter(|number| number.is_finite())
        };
        Self {
            scale: number("scale").filter(|scale| *scale != 0.0).unwrap_or(1.0),
            offset: number("offset").unwrap_or_default(),
            unit: item("unittype").unwrap_or_default().to_owned(),
        }
    }
}

/// The position of the first pixel's node, and the steps to the next nodes.
struct Placed {
    origin: DVec2,
    step_u: DVec2,
    step_v: DVec2,
}

impl Placed {
    fn of(file: &mut Decoder<Cursor<&[u8]>>, keys: &GeoKeys) -> Result<Self, String> {
        if keys.short(MODEL_TYPE) == Some(GEOCENTRIC) {
            return Err("its places are geocentric; project it to a plane".into());
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
        let inset = if keys.short(RASTER_TYPE) == Some(PIXEL_IS_POINT) {
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
