//! CityJSON 1 and 2, a whole document or a sequence of features a line (CityJSONSeq): an entity a city object, its parts below
//! it, its geometries the levels of one mesh and the coarsest of them its proxy. The format is Delft University of Technology's
//! (Hugo Ledoux and others, "CityJSON: a compact and easy-to-use encoding of the CityGML data model", 2019).
//!
//! Read are all surfaces and solids. Points, lines, instances of templates, textures and attributes are not. Objects keep
//! their true coordinates, east along X, up along Y and south along Z.

mod boundary;
mod document;
mod look;
mod place;
mod surface;
mod tree;

use crate::budget::Budget;
use crate::error::LoadProblem;
use antumbra_scene::Scene;
use document::{Document, Transform};
use place::Placer;

const SEQUENCE: &str = "CityJSON";
const FEATURE: &str = "CityJSONFeature";

/// Reads a sequence line by line: no more than one line's JSON is in memory at a time. What is spread over several lines is
/// read as one document.
pub(super) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Scene, LoadProblem> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = lines(bytes);
    let Some((number, line)) = lines.next() else {
        return Err(broken("the file".into(), "it is empty".into()));
    };
    let (first, is_whole) = match document::parse(number, line, budget) {
        Ok(first) => (first, false),
        // The first of several lines seldom is a document of its own.
        Err(error) if error.is_cut_off && lines.next().is_some() => {
            (document::parse(1, bytes, budget)?, true)
        }
        Err(error) => return Err(error.into()),
    };
    let transform = head(&first, number)?;
    let mut placer = Placer::new(budget);
    placer.place(&first, &transform, number)?;
    if !is_whole {
        for (number, line) in self::lines(bytes).skip(1) {
            let feature = document::parse(number, line, placer.budget)?;
            if feature.kind != FEATURE {
                let problem = format!(
                    "its type is \"{}\"; after the first line only {FEATURE} may follow",
                    shorten(&feature.kind)
                );
                return Err(broken(format!("line {number}"), problem));
            }
            placer.place(&feature, &transform, number)?;
        }
    }
    Ok(placer.finish())
}

/// What the first document says of all: that it is one, and where its vertices are.
fn head(first: &Document<'_>, number: usize) -> Result<Transform, LoadProblem> {
    let place = || format!("line {number}");
    if first.kind != SEQUENCE {
        let problem = format!(
            "its type is \"{}\"; the first line of a file must be of the type {SEQUENCE} and have the transform of all that follow",
            shorten(&first.kind)
        );
        return Err(broken(place(), problem));
    }
    let version = first.version.as_deref().unwrap_or("missing");
    if !version.starts_with("1.") && !version.starts_with("2.") {
        let problem = format!(
            "its version is {}; only 1.x and 2.x are known: convert the file",
            shorten(version)
        );
        return Err(broken(place(), problem));
    }
    let transform = match first.transform {
        Some(transform) => transform,
        // There, and there alone, vertices may be what they are.
        None if version == "1.0" => Transform::default(),
        None => {
            let problem = "it has no \"transform\"; without one nothing can be placed";
            return Err(broken(place(), problem.into()));
        }
    };
    let numbers = transform.scale.iter().chain(&transform.translate);
    if let Some(number) = numbers.copied().find(|number| !number.is_finite()) {
        let problem = format!("the transform has the number {number}");
        return Err(broken(place(), problem));
    }
    Ok(transform)
}

/// Lines with something in them, counted from 1.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let all = bytes.split(|byte| *byte == b'\n').enumerate();
    all.map(|(i, line)| (i + 1, line.trim_ascii()))
        .filter(|(_, line)| !line.is_empty())
}

fn broken(place: String, problem: String) -> LoadProblem {
    LoadProblem::Syntax {
        format: "CityJSON",
        place,
        problem,
    }
}

/// As much of a name as a message needs.
fn shorten(name: &str) -> String {
    match name.char_indices().nth(60) {
        Some((end, _)) => format!("{}...", name.get(..end).unwrap_or_default()),
        None => name.to_owned(),
    }
}
