//! KHR_draco_mesh_compression: primitives compressed by Draco (Google), decoded by the crate `draco-core`.

use super::document::Document;
use super::extensions::DRACO;
use crate::budget::Budget;
use crate::error::LoadProblem;
use draco_core::{DataType, DecodeLimits, DecoderBuffer, Mesh, MeshDecoder, PointIndex};
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::mesh::{Primitive, Semantic};
use serde::Deserialize;
use std::collections::BTreeMap;

/// A decoded primitive.
pub(super) struct Decoded {
    mesh: Mesh,
    /// The attributes' numbers in the mesh, by their names in the file.
    attributes: BTreeMap<String, u32>,
}

/// The values of an attribute, one for each vertex, as an accessor would have them.
pub(super) struct Values {
    pub(super) bytes: Vec<u8>,
    pub(super) count: usize,
    pub(super) shape: Type,
    pub(super) component: ComponentType,
}

/// The extension's object in a primitive.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Compressed {
    buffer_view: usize,
    attributes: BTreeMap<String, u32>,
}

/// Bytes of memory for each byte of decoded values: the decoder's, and those of the accessors.
const COPIES: u64 = 3;

/// Decodes a primitive; `None` for one that is not compressed, or has another form that the file prefers.
///
/// # Errors
/// Bytes that are no mesh; what exceeds the budget.
pub(super) fn decode(
    document: &Document<'_>,
    source: &Primitive,
    name: &str,
    budget: &mut Budget,
) -> Result<Option<Decoded>, LoadProblem> {
    let others = source
        .extensions
        .as_ref()
        .map(|extensions| &extensions.others);
    let found = others.and_then(|others| others.get(DRACO));
    // A list would be read as the members in their order.
    let Some(found) = found.filter(|found| found.is_object()) else {
        return Ok(None);
    };
    // A file that does not require the extension has its data in another form, too.
    if !document.root.extensions_required.iter().any(|r| r == DRACO) {
        return Ok(None);
    }
    let bad = |problem: String| LoadProblem::BadPrimitive {
        primitive: format!("the compressed {name}"),
        problem: format!("{problem}; export the file again"),
    };
    let compressed = Compressed::deserialize(found).map_err(|error| bad(error.to_string()))?;
    let view = document.view(name, compressed.buffer_view)?;
    let mut limits = DecodeLimits::default();
    limits.max_points = budget.options.max_vertices;
    limits.max_faces = budget.options.max_triangles;
    limits.max_decoded_bytes = budget.memory_left() / COPIES;
    let mut mesh = Mesh::new();
    let mut buffer = DecoderBuffer::new(view.bytes).with_limits(limits);
    let mut decoder = MeshDecoder::new();
    (decoder.decode(&mut buffer, &mut mesh)).map_err(|error| bad(error.to_string()))?;
    let attributes = 0..mesh.num_attributes();
    let sizes = attributes.filter_map(|id| {
        let attribute = mesh.try_attribute(id).ok()?;
        Some(attribute.buffer().data_size() as u64)
    });
    let size = sizes.sum::<u64>() + 12 * mesh.num_faces() as u64;
    budget.memory(size.saturating_mul(COPIES))?;
    Ok(Some(Decoded {
        mesh,
        attributes: compressed.attributes,
    }))
}

impl Decoded {
    /// The corners of all triangles.
    pub(super) fn indices(&self) -> Vec<u32> {
        let faces = self.mesh.faces().iter();
        faces.flat_map(|face| face.map(|point| point.0)).collect()
    }

    /// The values of an attribute; `None` if it is not compressed.
    ///
    /// # Errors
    /// Why they are none that an accessor can have.
    pub(super) fn values(&self, semantic: &Semantic) -> Result<Option<Values>, String> {
        let Some(id) = self.attributes.get(&semantic.to_string()) else {
            return Ok(None);
        };
        let attribute = self.mesh.attribute_by_unique_id(*id);
        let attribute = attribute.ok_or_else(|| format!("there is no attribute {id}"))?;
        let component = match attribute.data_type() {
            DataType::Int8 => ComponentType::I8,
            DataType::Uint8 => ComponentType::U8,
            DataType::Int16 => ComponentType::I16,
            DataType::Uint16 => ComponentType::U16,
            DataType::Uint32 => ComponentType::U32,
            DataType::Float32 => ComponentType::F32,
            other => return Err(format!("values of {other:?} are unknown")),
        };
        let shape = match attribute.num_components() {
            1 => Type::Scalar,
            2 => Type::Vec2,
            3 => Type::Vec3,
            4 => Type::Vec4,
            many => return Err(format!("{many} numbers for a vertex")),
        };
        let size = component.size() * shape.multiplicity();
        let stride = usize::try_from(attribute.byte_stride()).unwrap_or(size);
        let count = self.mesh.num_points();
        let data = attribute.buffer().data();
        let mut bytes = Vec::with_capacity(count * size);
        for point in 0..count as u32 {
            let value = attribute.mapped_index(PointIndex(point)).0 as usize;
            let start = value.checked_mul(stride);
            let value = start.and_then(|start| data.get(start..)?.get(..size));
            bytes.extend_from_slice(value.ok_or("a vertex without a value")?);
        }
        Ok(Some(Values {
            bytes,
            count,
            shape,
            component,
        }))
    }
}
