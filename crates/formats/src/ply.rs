//! PLY, read by the crate `ply-rs-bw`: ASCII and both binary byte orders. The counts in the header are checked
//! against the following bytes before an element is read.

use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use antumbra_scene::{Geometry, Topology};
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

/// The attributes of a vertex that are read.
#[derive(Default)]
struct Vertex {
    position: [f32; 3],
    normal: [f32; 3],
    uv: [f32; 2],
    colour: [u8; 4],
}

/// A face.
#[derive(Default)]
struct Face {
    corners: Vec<u32>,
}

/// An element that is skipped.
struct Skipped;

/// Bytes of a face's list of corners, without the corners.
const FACE: u64 = 64;

/// Reads vertices and faces. Polygons become fans of triangles. Without faces the vertices are points.
pub(super) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Geometry, LoadProblem> {
    let broken = |place: &str, problem: String| LoadProblem::Syntax {
        format: "PLY",
        place: place.to_owned(),
        // The crate quotes the invalid line, however long it is.
        problem: problem.chars().take(300).collect(),
    };
    if !bytes.starts_with(b"ply") {
        return Err(broken("the start", "it does not begin with \"ply\"".into()));
    }
    let mut reader = Reader::new(bytes);
    let header = Parser::<Skipped>::new().read_header(&mut reader);
    let header = header.map_err(|e| broken("the header", e.to_string()))?;
    let mut geometry = Geometry::default();
    let mut faces = Vec::new();
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
                let vertices = Parser::<Vertex>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(failed)?;
                take_vertices(&vertices, element, &mut geometry);
            }
            "face" => {
                budget.triangles(element.count as u64)?;
                // A list of corners each, and the bytes that they are read from.
                budget.memory(
                    (element.count as u64)
                        .saturating_mul(FACE)
                        .saturating_add(left),
                )?;
                faces = Parser::<Face>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(failed)?;
            }
            _ => {
                Parser::<Skipped>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(failed)?;
            }
        }
    }
    if faces.is_empty() {
        geometry.topology = Topology::Points;
        geometry.indices = (0..geometry.positions.len() as u32).collect();
        return Ok(geometry);
    }
    let triangles = faces
        .iter()
        .map(|f| f.corners.len().saturating_sub(2))
        .sum::<usize>();
    budget.triangles(triangles.saturating_sub(faces.len()) as u64)?;
    geometry.indices.reserve(triangles * 3);
    for face in &faces {
        if let [first, rest @ ..] = face.corners.as_slice() {
            for pair in rest.windows(2) {
                geometry.indices.push(*first);
                geometry.indices.extend_from_slice(pair);
            }
        }
    }
    Ok(geometry)
}

fn take_vertices(vertices: &[Vertex], element: &ElementDef, geometry: &mut Geometry) {
    let has = |names: &[&str]| {
        names
            .iter()
            .any(|name| element.properties.contains_key(*name))
    };
    geometry.positions = vertices.iter().map(|v| v.position).collect();
    if has(&["nx"]) {
        geometry.normals = vertices.iter().map(|v| v.normal).collect();
    }
    if has(&["u", "s", "texture_u"]) {
        geometry.uvs = vertices.iter().map(|v| v.uv).collect();
    }
    if has(&["red", "r", "diffuse_red"]) {
        let opaque = !has(&["alpha", "a"]);
        let colour = |v: &Vertex| {
            let [r, g, b, a] = v.colour;
            [r, g, b, if opaque { 255 } else { a }]
        };
        geometry.colours = vertices.iter().map(colour).collect();
    }
}

/// The least number of bytes of an element, at least 1: an element without properties still takes memory.
fn least_size(element: &ElementDef, encoding: Encoding) -> u64 {
    let size = |scalar: &ScalarType| match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    };
    let least = |property: &PropertyType| match (encoding, property) {
        // A digit and a separator.
        (Encoding::Ascii, _) => 2,
        (_, PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) => size(scalar),
    };
    let properties = element.properties.iter().map(|(_, p)| least(&p.data_type));
    properties.sum::<u64>().max(1)
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let [x, y, z] = &mut self.position;
        let [nx, ny, nz] = &mut self.normal;
        let [u, v] = &mut self.uv;
        let number = match name {
            "x" => x,
            "y" => y,
            "z" => z,
            "nx" => nx,
            "ny" => ny,
            "nz" => nz,
            "u" | "s" | "texture_u" => u,
            "v" | "t" | "texture_v" => v,
            _ => return self.set_colour(name, &property),
        };
        match property.to_f32_lossy() {
            Some(value) => *number = value,
            None => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}

impl Vertex {
    fn set_colour(&mut self, name: &str, property: &Property) -> PropertyAccessResult {
        let [r, g, b, a] = &mut self.colour;
        let channel = match name {
            "red" | "r" | "diffuse_red" => r,
            "green" | "g" | "diffuse_green" => g,
            "blue" | "b" | "diffuse_blue" => b,
            "alpha" | "a" => a,
            _ => return PropertyAccessResult::Ignored,
        };
        match property.to_u8_color_lossy() {
            Some(value) => *channel = value,
            None => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if name != "vertex_indices" && name != "vertex_index" {
            return PropertyAccessResult::Ignored;
        }
        match property.to_u32_list() {
            Some(corners) => self.corners = corners,
            None => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}
