//! The container: the chunks of a binary glTF, and the JSON in them.

use super::{extensions, pointers};
use crate::budget::Budget;
use crate::error::LoadProblem;
use gltf::json::Root;
use gltf::json::extras::RawValue;
use serde::Deserialize;

/// The parts of a file.
pub(super) struct Parts<'a> {
    pub(super) json: &'a [u8],
    pub(super) binary: Option<&'a [u8]>,
}

/// The parsed JSON.
pub(super) struct Json<'a> {
    pub(super) root: Root,
    /// The text of each node.
    pub(super) nodes: Vec<&'a RawValue>,
}

/// The part of the JSON with the version.
#[derive(Deserialize)]
struct Head {
    asset: Option<Asset>,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Asset {
    /// A string; a number in files of version 1.
    version: Option<serde_json::Value>,
    min_version: Option<serde_json::Value>,
}

/// The part of the JSON that is read a second time.
#[derive(Deserialize)]
struct NodeTexts<'a> {
    #[serde(borrow, default)]
    nodes: Vec<&'a RawValue>,
}

const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;

/// The chunks of a binary file; any other file is JSON.
pub(super) fn split(bytes: &[u8]) -> Result<Parts<'_>, LoadProblem> {
    if !bytes.starts_with(b"glTF") {
        return Ok(Parts {
            json: bytes,
            binary: None,
        });
    }
    let number = |at: usize| {
        let bytes = bytes.get(at..)?.first_chunk::<4>()?;
        Some(u32::from_le_bytes(*bytes))
    };
    let short = |what: &str, needed: u64, available: usize| LoadProblem::Truncated {
        what: what.to_owned(),
        needed,
        available: available as u64,
    };
    let (Some(version), Some(length)) = (number(4), number(8)) else {
        return Err(short("the GLB header", HEADER as u64, bytes.len()));
    };
    if version != 2 {
        return Err(LoadProblem::Syntax {
            format: "glTF",
            place: "the GLB header".into(),
            problem: format!("its version is {version}; only 2 is known: convert the file"),
        });
    }
    // The length in the header must not exceed the file. Bytes beyond it are ignored.
    let whole = bytes
        .get(..length as usize)
        .ok_or_else(|| short("the GLB file", u64::from(length), bytes.len()))?;
    let mut rest = whole.get(HEADER..).unwrap_or_default();
    let mut chunks = Vec::new();
    while let Some((head, after)) = rest.split_first_chunk::<CHUNK_HEADER>() {
        let [l0, l1, l2, l3, kind @ ..] = *head;
        let length = u32::from_le_bytes([l0, l1, l2, l3]);
        let name = format!("GLB chunk {}", chunks.len());
        let body = after
            .get(..length as usize)
            .ok_or_else(|| short(&name, u64::from(length), after.len()))?;
        chunks.push((kind, body));
        rest = after.get(body.len()..).unwrap_or_default();
        if chunks.len() == 2 {
            break;
        }
    }
    let found = |wanted: &[u8; 4]| {
        let chunk = chunks.iter().find(|(kind, _)| kind == wanted);
        chunk.map(|(_, body)| *body)
    };
    let json = found(b"JSON").ok_or_else(|| LoadProblem::Syntax {
        format: "glTF",
        place: "the GLB file".into(),
        problem: "it has no JSON chunk".into(),
    })?;
    Ok(Parts {
        json,
        binary: found(b"BIN\0"),
    })
}

/// Parses the JSON, if its version and required extensions are supported.
pub(super) fn parse<'a>(json: &'a [u8], budget: &mut Budget) -> Result<Json<'a>, LoadProblem> {
    budget.json(json)?;
    let broken = |place: &str, problem: String| LoadProblem::Syntax {
        format: "glTF",
        place: place.to_owned(),
        problem,
    };
    // The version is checked first, since older versions have errors in every line.
    let head: Head = serde_json::from_slice(json).map_err(|e| broken("the JSON", e.to_string()))?;
    let asset = head.asset.unwrap_or_default();
    let version = asset.min_version.or(asset.version).unwrap_or_default();
    if !version.as_str().is_some_and(|v| v.starts_with("2.")) {
        let problem = format!("it is {version}; only 2.x is known: convert the file");
        return Err(broken("asset.version", problem));
    }
    let root = match Root::from_slice(json) {
        Ok(root) => root,
        Err(error) => match pointers::without(json, &mut budget.left_out) {
            Some(root) => root,
            None => return Err(broken("the JSON", error.to_string())),
        },
    };
    extensions::check(&root)?;
    let texts: NodeTexts<'_> =
        serde_json::from_slice(json).map_err(|e| broken("the JSON", e.to_string()))?;
    Ok(Json {
        root,
        nodes: texts.nodes,
    })
}
