//! The part of a document's JSON that is read, borrowed from its text where possible. Boundaries stay text until
//! their type is known, which may follow them and determines their depth.

use super::error::syntax_error;
use crate::budget::Budget;
use crate::error::LoadProblem;
use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};
use serde_json::Value;
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::fmt;

/// The first line of a sequence, one of its features, or a whole file.
#[derive(Deserialize)]
pub(super) struct Document<'a> {
    #[serde(rename = "type", borrow, default)]
    pub(super) kind: Cow<'a, str>,
    #[serde(borrow)]
    pub(super) version: Option<Cow<'a, str>>,
    pub(super) transform: Option<Transform>,
    #[serde(rename = "CityObjects", borrow, default)]
    pub(super) objects: Objects<'a>,
    /// Vertices in steps of the transform's scale, with Z up.
    #[serde(default)]
    pub(super) vertices: Vec<[f64; 3]>,
    #[serde(rename = "geometry-templates", borrow)]
    pub(super) templates: Option<Templates<'a>>,
    pub(super) appearance: Option<Appearance>,
}

/// How surfaces look. It is counted and not read.
#[derive(Deserialize)]
pub(super) struct Appearance {
    #[serde(default)]
    pub(super) textures: Vec<IgnoredAny>,
    #[serde(default)]
    pub(super) materials: Vec<IgnoredAny>,
}

/// Geometries that objects place, such as one tree for a whole street.
#[derive(Deserialize)]
pub(super) struct Templates<'a> {
    #[serde(borrow, default)]
    pub(super) templates: Vec<Geometry<'a>>,
    /// Their vertices in metres, with Z up.
    #[serde(rename = "vertices-templates", default)]
    pub(super) vertices: Vec<[f64; 3]>,
}

/// The transform from vertices to metres.
#[derive(Clone, Copy, Deserialize)]
pub(super) struct Transform {
    pub(super) scale: [f64; 3],
    pub(super) translate: [f64; 3],
}

impl Default for Transform {
    fn default() -> Self {
        Self {
            scale: [1.0; 3],
            translate: [0.0; 3],
        }
    }
}

/// The city objects with their ids, in the file's order.
#[derive(Default)]
pub(super) struct Objects<'a>(pub(super) Vec<(Cow<'a, str>, CityObject<'a>)>);

/// A city object, such as a building, a part of one, a road or a tree.
#[derive(Deserialize)]
pub(super) struct CityObject<'a> {
    #[serde(rename = "type", borrow)]
    pub(super) kind: Cow<'a, str>,
    #[serde(borrow, default)]
    pub(super) parents: Vec<Cow<'a, str>>,
    #[serde(borrow, default)]
    pub(super) children: Vec<Cow<'a, str>>,
    #[serde(borrow, default)]
    pub(super) geometry: Vec<Geometry<'a>>,
}

/// The geometry of an object at one level of detail.
#[derive(Deserialize)]
pub(super) struct Geometry<'a> {
    #[serde(rename = "type", borrow)]
    pub(super) kind: Cow<'a, str>,
    lod: Option<Value>,
    #[serde(borrow)]
    pub(super) boundaries: Option<&'a RawValue>,
    #[serde(borrow)]
    pub(super) semantics: Option<Semantics<'a>>,
    /// The number of the template that an instance places.
    pub(super) template: Option<usize>,
    /// How it is placed at its one vertex: 4 x 4 numbers, row by row.
    #[serde(rename = "transformationMatrix", borrow)]
    pub(super) matrix: Option<&'a RawValue>,
}

/// The semantics of surfaces: which are walls and which are roofs.
#[derive(Deserialize)]
pub(super) struct Semantics<'a> {
    #[serde(borrow, default)]
    pub(super) surfaces: Vec<SurfaceKind<'a>>,
    #[serde(borrow)]
    pub(super) values: Option<&'a RawValue>,
}

#[derive(Deserialize)]
pub(super) struct SurfaceKind<'a> {
    #[serde(rename = "type", borrow, default)]
    pub(super) kind: Cow<'a, str>,
}

impl Geometry<'_> {
    /// The level of detail; a greater number is finer. It is a text in newer versions and a number in older ones.
    pub(super) fn lod(&self) -> f64 {
        let number = match &self.lod {
            Some(Value::String(text)) => text.parse().ok(),
            Some(Value::Number(number)) => number.as_f64(),
            _ => None,
        };
        number.filter(|n: &f64| n.is_finite()).unwrap_or_default()
    }
}

/// Why a document cannot be read.
pub(super) struct Unread {
    problem: LoadProblem,
    /// Whether the text ends too early.
    pub(super) is_cut_off: bool,
}

impl From<Unread> for LoadProblem {
    fn from(unread: Unread) -> Self {
        unread.problem
    }
}

/// Parses the document that begins on line `number`.
pub(super) fn parse<'a>(
    number: usize,
    text: &'a [u8],
    budget: &Budget,
) -> Result<Document<'a>, Unread> {
    budget.json(text).map_err(|problem| Unread {
        problem,
        is_cut_off: false,
    })?;
    serde_json::from_slice(text).map_err(|error| Unread {
        is_cut_off: error.is_eof(),
        problem: syntax(number, &error),
    })
}

/// An error of the JSON parser, with the line of the file.
fn syntax(number: usize, error: &serde_json::Error) -> LoadProblem {
    let line = number + error.line().saturating_sub(1);
    syntax_error(
        format!("line {line}, column {}", error.column()),
        reason(error),
    )
}

/// The message of a parser's error without its position, at most 300 characters.
pub(super) fn reason(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let reason = text
        .rsplit_once(" at line ")
        .map_or(&*text, |(head, _)| head);
    reason.chars().take(300).collect()
}

impl<'de: 'a, 'a> Deserialize<'de> for Objects<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries;

        impl<'de> Visitor<'de> for Entries {
            type Value = Objects<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("city objects by their ids")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Objects<'de>, A::Error> {
                let mut objects = Vec::new();
                while let Some(Id(id)) = map.next_key()? {
                    objects.push((id, map.next_value()?));
                }
                Ok(Objects(objects))
            }
        }

        deserializer.deserialize_map(Entries)
    }
}

/// `Cow` alone would always copy.
#[derive(Deserialize)]
struct Id<'a>(#[serde(borrow)] Cow<'a, str>);
