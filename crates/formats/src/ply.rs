//! PLY, read by the crate `ply-rs-bw`: ASCII and both binary byte orders. The counts in the header are checked
//! against the following bytes before an element is read.

mod elements;
mod mesh;
mod text;

use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use crate::left_out::{LeftOut, LostPart};
use crate::local_origin::Placed;
use antumbra_scene::Scene;
use elements::{CORNERS, CORNERS_TOO, Face, Skipped, Strips, Vertex};
use mesh::{Attributes, Elements};
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, PropertyType, ScalarType};
use text::Parts;

/// Bytes of a face's list of corners, without the corners.
const FACE: u64 = 64;

/// Reads vertices, faces and strips of triangles. Without faces and strips the vertices are points.
pub(super) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Scene, LoadProblem> {
    let broken = |place: &str, problem: String| LoadProblem::Syntax {
        format: "PLY",
        place: place.to_owned(),
        // The crate quotes the invalid line, however long it is.
        problem: problem.chars().take(300).collect(),
    };
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if !bytes.starts_with(b"ply") {
        return Err(broken("the start", "it does not begin with \"ply\"".into()));
    }
    let Parts { header, body } = text::split(bytes, budget)?
        .ok_or_else(|| broken("the header", "it has no end_header".into()))?;
    let header = Parser::<Skipped>::new().read_header(&mut Reader::new(header.as_bytes()));
    let header = header.map_err(|e| broken("the header", e.to_string()))?;
    let mut reader = Reader::new(&*body);
    let mut elements = Elements::default();
    for (_, element) in &header.elements {
        let left = reader.get_ref().len() as u64;
        let needed = (element.count as u64).saturating_mul(least_size(element, header.encoding));
        // The last line of an ASCII file may lack its end.
        if needed > left + 1 {
            return Err(LoadProblem::Truncated {
                what: format!("{} elements \"{}\"", element.count, shorten(&element.name)),
                needed,
                available: left,
            });
        }
        let failed = |e: ply_rs_bw::parser::ParseError| {
            broken(
                &format!("element \"{}\"", shorten(&element.name)),
                e.to_string(),
            )
        };
        budget.enter(format!(
            "{} elements \"{}\"",
            element.count,
            shorten(&element.name)
        ));
        match element.name.as_str() {
            "vertex" => {
                budget.vertices(element.count as u64)?;
                elements.attributes = Attributes::of(element);
                elements.vertices = Parser::<Vertex>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(failed)?;
            }
            "face" => {
                budget.triangles(element.count as u64)?;
                // A list of corners each, of four bytes a corner.
                budget.memory((element.count as u64).saturating_mul(FACE))?;
                budget.memory(most_items(element, header.encoding, left).saturating_mul(4))?;
                note_unread(element, &mut budget.left_out);
                elements.faces = Parser::<Face>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(failed)?;
            }
            "tristrips" => {
                // Eight bytes a corner, and a copy while a list is read.
                budget.memory((element.count as u64).saturating_mul(FACE))?;
                budget.memory(most_items(element, header.encoding, left).saturating_mul(16))?;
                note_unread(element, &mut budget.left_out);
                elements.strips = Parser::<Strips>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(failed)?;
            }
            name => {
                let reason = format!("\"{}\"", shorten(name));
                let count = element.count as u64;
                (budget.left_out).add_many(LostPart::Element, &reason, count, "after the header");
                Parser::<Skipped>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(failed)?;
            }
        }
    }
    budget.enter("the mesh");
    budget.entities(1)?;
    budget.mesh("ply")?;
    let Placed {
        geometry,
        transform,
    } = elements.into_placed(budget)?;
    let mut scene = Scene::new();
    crate::single::spawn(&mut scene, "ply", geometry, transform)?;
    Ok(scene)
}

/// The least number of bytes of an element, at least 1: an element without properties still takes memory.
fn least_size(element: &ElementDef, encoding: Encoding) -> u64 {
    let least = |property: &PropertyType| match (encoding, property) {
        // A digit and a separator.
        (Encoding::Ascii, _) => 2,
        (_, PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) => size(scalar),
    };
    let properties = element.properties.iter().map(|(_, p)| least(&p.data_type));
    properties.sum::<u64>().max(1)
}

/// The most items that the lists of an element can have in these many bytes.
fn most_items(element: &ElementDef, encoding: Encoding, bytes: u64) -> u64 {
    let least = element.properties.iter().filter_map(|(_, property)| {
        match (&property.data_type, encoding) {
            (PropertyType::Scalar(_), _) => None,
            (PropertyType::List(..), Encoding::Ascii) => Some(2),
            (PropertyType::List(_, item), _) => Some(size(item)),
        }
    });
    // The last number of an ASCII file may lack its end.
    least.min().map_or(0, |least| (bytes + 1) / least)
}

/// Bytes of a number in a binary file.
fn size(scalar: &ScalarType) -> u64 {
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// Notes the colours of faces, and their lists other than that of corners, such as texture coordinates. They are not read.
fn note_unread(element: &ElementDef, left_out: &mut LeftOut) {
    if element.count == 0 {
        return;
    }
    let place = format!("the element \"{}\"", shorten(&element.name));
    for (name, property) in &element.properties {
        let reason = match (name.as_str(), &property.data_type) {
            (CORNERS | CORNERS_TOO, _) => continue,
            ("red" | "r" | "diffuse_red", PropertyType::Scalar(_)) => "colours of faces".to_owned(),
            (_, PropertyType::Scalar(_)) => continue,
            (name, PropertyType::List(..)) => format!("the list \"{}\" of faces", shorten(name)),
        };
        left_out.add(LostPart::Attribute, &reason, &place);
    }
}
