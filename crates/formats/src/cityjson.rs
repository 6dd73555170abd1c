//! CityJSON 1 and 2: a whole document, or a sequence with one feature per line (CityJSONSeq).
//!
//! Each city object becomes an entity, and its parts become children. The geometries of an object become the levels
//! of one mesh, and the coarsest of them its proxy. The format is Delft University of Technology's (Hugo Ledoux and
//! others, "CityJSON: a compact and easy-to-use encoding of the CityGML data model", 2019).
//!
//! All geometries are read: surfaces, solids, lines, points, and instances of templates. Textures and attributes are not. Objects keep their
//! true coordinates, east along X, up along Y and south along Z.

mod boundary;
mod document;
mod error;
mod materials;
mod scene_builder;
mod templates;
mod tree;

use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use antumbra_scene::Scene;
use document::{Document, Transform};
use error::syntax_error;
use scene_builder::SceneBuilder;

const SEQUENCE: &str = "CityJSON";
const FEATURE: &str = "CityJSONFeature";

/// Reads a sequence line by line, with the JSON of one line in memory at a time. A document that spans several lines
/// is read as a whole.
pub(super) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Scene, LoadProblem> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = lines(bytes);
    let Some((number, line)) = lines.next() else {
        return Err(syntax_error("the file".into(), "it is empty".into()));
    };
    let (first, is_whole) = match document::parse(number, line, budget) {
        Ok(first) => (first, false),
        // The first of several lines is usually not a document of its own.
        Err(error) if error.is_cut_off && lines.next().is_some() => {
            (document::parse(1, bytes, budget)?, true)
        }
        Err(error) => return Err(error.into()),
    };
    let transform = head(&first, number)?;
    let mut builder = SceneBuilder::new(budget);
    builder.add_document(&first, &transform, number)?;
    if !is_whole {
        for (number, line) in self::lines(bytes).skip(1) {
            let feature = document::parse(number, line, builder.budget)?;
            if feature.kind != FEATURE {
                let problem = format!(
                    "its type is \"{}\"; after the first line only {FEATURE} is allowed",
                    shorten(&feature.kind)
                );
                return Err(syntax_error(format!("line {number}"), problem));
            }
            builder.add_document(&feature, &transform, number)?;
        }
    }
    Ok(builder.finish())
}

/// The version and the transform, which the first document specifies for all.
fn head(first: &Document<'_>, number: usize) -> Result<Transform, LoadProblem> {
    let place = || format!("line {number}");
    if first.kind != SEQUENCE {
        let problem = format!(
            "its type is \"{}\"; the first line of a file must have the type {SEQUENCE} and the transform of all lines",
            shorten(&first.kind)
        );
        return Err(syntax_error(place(), problem));
    }
    let version = first.version.as_deref().unwrap_or("missing");
    if !version.starts_with("1.") && !version.starts_with("2.") {
        let problem = format!(
            "its version is {}; only 1.x and 2.x are known: convert the file",
            shorten(version)
        );
        return Err(syntax_error(place(), problem));
    }
    let transform = match first.transform {
        Some(transform) => transform,
        // Only version 1.0 allows vertices without a transform.
        None if version == "1.0" => Transform::default(),
        None => {
            let problem = "it has no \"transform\"; without one its objects have no position";
            return Err(syntax_error(place(), problem.into()));
        }
    };
    let numbers = transform.scale.iter().chain(&transform.translate);
    if let Some(number) = numbers.copied().find(|number| !number.is_finite()) {
        let problem = format!("the transform has the number {number}");
        return Err(syntax_error(place(), problem));
    }
    Ok(transform)
}

/// The lines that are not empty, numbered from 1.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let all = bytes.split(|byte| *byte == b'\n').enumerate();
    all.map(|(i, line)| (i + 1, line.trim_ascii()))
        .filter(|(_, line)| !line.is_empty())
}
