//! Values of options, read from their text. Each message shows how the value is written.

use std::str::FromStr;

use antumbra::cull::{Latency, SettingRange};
use antumbra::measure::MeasureError;
use antumbra::measure::trade_off::ErrorLimit;
use antumbra::subsurface::{Axis, SampleBox};
use antumbra::terrain::Method;

/// Samples along three axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Samples(pub [u32; 3]);

impl FromStr for Samples {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides: Vec<u32> = text
            .split('x')
            .map_while(|side| side.parse().ok())
            .collect();
        let whole = text.split('x').count() == 3;
        <[u32; 3]>::try_from(sides)
            .ok()
            .filter(|sides| whole && sides.iter().all(|side| *side > 0))
            .map(Self)
            .ok_or_else(|| "write it as 256x256x128".to_owned())
    }
}

/// The axis that a slice is perpendicular to, and its sample along that axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SliceAt {
    /// The axis.
    pub axis: Axis,
    /// The sample, from 0.
    pub sample: u32,
}

impl FromStr for SliceAt {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (axis, sample) = text.split_once('=').unwrap_or((text, ""));
        let axis = Axis::ALL
            .into_iter()
            .find(|known| known.to_string() == axis);
        match (axis, sample.parse()) {
            (Some(axis), Ok(sample)) => Ok(Self { axis, sample }),
            _ => Err("write it as inline=120, crossline=80 or time=300".to_owned()),
        }
    }
}

/// The samples that a lens takes up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LensAt(pub SampleBox);

impl FromStr for LensAt {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ends = |part: &str| {
            let (first, last) = part.split_once("..")?;
            Some((first.parse().ok()?, last.parse().ok()?))
        };
        let parts: Vec<(u32, u32)> = text.split(',').map_while(ends).collect();
        match parts.as_slice() {
            [i, c, t] if text.split(',').count() == 3 => Ok(Self(SampleBox {
                min: [i.0, c.0, t.0],
                max: [i.1, c.1, t.1],
            })),
            _ => Err("write it as 100..180,60..120,200..320".to_owned()),
        }
    }
}

/// The values that a range of colours begins and ends with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitudes(pub [f32; 2]);

impl FromStr for Amplitudes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ends = text.split_once("..");
        let ends = ends.and_then(|(low, high)| Some([low.parse().ok()?, high.parse().ok()?]));
        ends.filter(|[low, high]: &[f32; 2]| low < high && (high - low).is_finite())
            .map(Self)
            .ok_or_else(|| "write it as -2500..2500".to_owned())
    }
}

/// An image's width and height in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size(pub [u32; 2]);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text
            .split_once('x')
            .and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
        match sides {
            Some([w, h]) if (1..=16_384).contains(&w) && (1..=16_384).contains(&h) => {
                Ok(Self([w, h]))
            }
            _ => Err("write it as 1280x1024; each side is 1 to 16384".to_owned()),
        }
    }
}

/// A camera path as `--path` names it. Any text is one: what is no word names a view or a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PathArg {
    /// `orbit`: around the scene.
    Orbit,
    /// `flight`: through the scene or over its terrain.
    Flight,
    /// `camera:NAME`: a camera of the scene; `None` for `camera`, the first one.
    Camera(Option<String>),
    /// A view of the built-in subsurface scene or, where it has none of that name, a file of poses.
    Named(String),
}

impl From<String> for PathArg {
    fn from(text: String) -> Self {
        match text.as_str() {
            "orbit" => Self::Orbit,
            "flight" => Self::Flight,
            "camera" => Self::Camera(None),
            named => match named.strip_prefix("camera:") {
                Some("") => Self::Camera(None),
                Some(name) => Self::Camera(Some(name.to_owned())),
                None => Self::Named(text),
            },
        }
    }
}

/// A setting of a built-in scene, written after its name: `tiles=5`, or its size alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SceneSetting<'a> {
    /// The key; `size` where the text is a value alone.
    pub key: &'a str,
    /// The value as text. The scene's options check it.
    pub value: &'a str,
}

impl<'a> SceneSetting<'a> {
    /// Reads `KEY=VALUE`, or a size.
    pub fn read(text: &'a str) -> Self {
        let (key, value) = text.split_once('=').unwrap_or(("size", text));
        Self { key, value }
    }
}

/// How horizons are computed.
pub fn method(text: &str) -> Result<Method, String> {
    text.parse()
        .map_err(|()| "it takes sound, rays or thesis".to_owned())
}

/// A limit of error.
pub fn limit(text: &str) -> Result<ErrorLimit, String> {
    text.parse()
        .map_err(|error: MeasureError| error.to_string())
}

/// A share above 0, at most 1.
pub fn share(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|share| *share > 0.0 && *share <= 1.0)
        .ok_or_else(|| "it takes a number above 0, at most 1".to_owned())
}

/// When the results of queries are used.
pub fn latency(text: &str) -> Result<Latency, String> {
    text.parse()
        .map_err(|()| format!("it takes {}", SettingRange::Words(Latency::WORDS)))
}
