//! The geometry of a primitive: a plain list of triangles, lines or points, the vertices that they use, and the
//! effect of morph targets and skin at rest.

use super::accessor::Accessor;
use super::deformation::Deformation;
use super::document::{Document, label};
#[cfg(feature = "draco")]
use super::draco::{self, Decoded};
use super::morph;
use super::skin::Pose;
use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::left_out::LostPart;
use crate::normals;
use antumbra_scene::{Geometry, Topology};
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;

/// The parameters for reading a primitive.
pub(super) struct Request<'a> {
    pub(super) mesh: usize,
    pub(super) primitive: usize,
    /// The set of texture coordinates that the material uses.
    pub(super) uv_set: u32,
    /// The weights of the morph targets.
    pub(super) weights: &'a [f32],
    /// The skin at rest.
    pub(super) pose: Option<&'a Pose>,
    /// Whether what deforms it is kept.
    pub(super) deforms: bool,
}

impl Request<'_> {
    /// What the primitive is called in messages.
    pub(super) fn label(&self, document: &Document<'_>) -> String {
        let mesh = document.root.meshes.get(self.mesh);
        let name = mesh.and_then(|mesh| mesh.name.as_deref());
        let mesh = label("mesh", self.mesh, name);
        format!("{mesh}, primitive {}", self.primitive)
    }
}

/// A primitive at rest.
pub(super) struct ReadGeometry {
    pub(super) geometry: Geometry,
    /// What deforms it, if that was asked for.
    pub(super) deformation: Option<Deformation>,
}

/// Reads a primitive; `None` for one without positions, which glTF allows but which cannot be drawn.
pub(super) fn read(
    document: &Document<'_>,
    source: &Primitive,
    request: &Request<'_>,
    budget: &mut Budget,
) -> Result<Option<ReadGeometry>, LoadProblem> {
    let name = request.label(document);
    #[cfg(feature = "draco")]
    let decoded = draco::decode(document, source, &name, budget)?;
    let attribute =
        |semantic: Semantic, budget: &mut Budget| -> Result<Option<Accessor<'_>>, LoadProblem> {
            let user = format!("{} of {name}", semantic.to_string());
            let Some(index) = source.attributes.get(&Checked::Valid(semantic.clone())) else {
                return Ok(None);
            };
            #[cfg(feature = "draco")]
            if let Some(decoded) = &decoded {
                let values = decoded.values(&semantic);
                let values = values.map_err(|problem| LoadProblem::BadPrimitive {
                    primitive: user.clone(),
                    problem,
                })?;
                if let Some(values) = values {
                    let accessor = Accessor::of_values(values, document, index.value(), &user)?;
                    return Ok(Some(accessor));
                }
            }
            Accessor::open(document, index.value(), &user, budget).map(Some)
        };
    let Some(positions) = attribute(Semantic::Positions, budget)? else {
        return Ok(None);
    };
    let fits = positions.shape == Type::Vec3 && positions.component != ComponentType::U32;
    positions.expect(fits, "positions")?;
    #[cfg(feature = "draco")]
    let compressed = decoded.as_ref().map(Decoded::indices);
    #[cfg(not(feature = "draco"))]
    let compressed: Option<Vec<u32>> = None;
    let IndexList { topology, indices } = match compressed {
        // The decoder gives indices within its own points.
        Some(indices) => {
            budget.triangles(indices.len() as u64 / 3)?;
            IndexList {
                topology: Topology::Triangles,
                indices,
            }
        }
        None => indices(document, source, positions.count, &name, budget)?,
    };
    let used = used_vertices(&indices, positions.count);
    let total = used.as_ref().map_or(positions.count, Vec::len);
    budget.vertices(total as u64)?;
    let mut geometry = Geometry {
        topology,
        indices: match &used {
            None => indices,
            Some(used) => {
                let place = |index: &u32| used.binary_search(index).unwrap_or_default() as u32;
                indices.iter().map(place).collect()
            }
        },
        ..Geometry::default()
    };
    let vertices = Vertices {
        used: used.as_deref(),
        all: positions.count,
    };
    geometry.positions = vertices
        .iter()
        .map(|v| positions.finite(v))
        .collect::<Result<_, _>>()?;
    let optional = |semantic: Semantic, fits: fn(Type) -> bool, what: &str, budget: &mut Budget| {
        let found = attribute(semantic, budget)?;
        if let Some(found) = &found {
            found.expect(fits(found.shape), what)?;
            same_count(found, positions.count)?;
        }
        Ok::<_, LoadProblem>(found)
    };
    if let Some(normals) = optional(Semantic::Normals, |t| t == Type::Vec3, "normals", budget)? {
        geometry.normals = vertices.iter().map(|v| normals.numbers(v)).collect();
        normals::mend(&mut geometry, &name, budget);
    }
    if let Some(uvs) = optional(
        Semantic::TexCoords(request.uv_set),
        |t| t == Type::Vec2,
        "texture coordinates",
        budget,
    )? {
        let mut lost = 0;
        geometry.uvs = vertices.iter().map(|v| uvs.or_zero(v, &mut lost)).collect();
        let reason = "texture coordinates that are not finite";
        let left_out = &mut budget.left_out;
        left_out.add_many(LostPart::Attribute, reason, lost, &name);
    }
    let is_colour = |t| matches!(t, Type::Vec3 | Type::Vec4);
    if let Some(colours) = optional(Semantic::Colors(0), is_colour, "colours", budget)? {
        let byte = |c: f32| (c.clamp(0.0, 1.0) * 255.0).round() as u8;
        let opaque = colours.shape == Type::Vec3;
        let colour = |v| {
            let [r, g, b, a] = colours.numbers::<4>(v).map(byte);
            [r, g, b, if opaque { 255 } else { a }]
        };
        geometry.colours = vertices.iter().map(colour).collect();
    }
    let mut deformation = request.deforms.then(|| Deformation::of(&geometry));
    if deformation.is_some() {
        budget.memory((total as u64).saturating_mul(Deformation::VERTEX))?;
    }
    morph::apply(
        document,
        source,
        request,
        &vertices,
        budget,
        &mut geometry,
        deformation.as_mut(),
    )?;
    if let Some(pose) = request.pose {
        let mut sets = Vec::new();
        for set in 0.. {
            let joints = optional(Semantic::Joints(set), |t| t == Type::Vec4, "joints", budget)?;
            let weights = optional(
                Semantic::Weights(set),
                |t| t == Type::Vec4,
                "weights",
                budget,
            )?;
            let (Some(joints), Some(weights)) = (joints, weights) else {
                break;
            };
            sets.push((joints, weights));
        }
        let influences = pose.influences(&sets, &vertices, budget)?;
        pose.apply(&influences, &mut geometry);
        if let Some(deformation) = &mut deformation {
            deformation.influences = influences;
        }
    }
    Ok(Some(ReadGeometry {
        geometry,
        deformation,
    }))
}

/// Which elements of a primitive's accessors are the vertices of its geometry.
pub(super) struct Vertices<'a> {
    /// These; `None` for all.
    used: Option<&'a [u32]>,
    /// The elements of each accessor.
    pub(super) all: usize,
}

impl Vertices<'_> {
    pub(super) fn count(&self) -> usize {
        self.used.map_or(self.all, <[u32]>::len)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        let element = |vertex| {
            let used = self.used.and_then(|used| used.get(vertex));
            used.map_or(vertex, |element| *element as usize)
        };
        (0..self.count()).map(element)
    }
}

pub(super) fn same_count(accessor: &Accessor<'_>, positions: usize) -> Result<(), LoadProblem> {
    if accessor.count == positions {
        return Ok(());
    }
    let problem = format!(
        "{} elements for {positions} positions; there must be one each",
        accessor.count
    );
    Err(accessor.bad(problem))
}

/// The primitives of a mesh as a plain list.
struct IndexList {
    topology: Topology,
    indices: Vec<u32>,
}

/// The vertex indices of every triangle, line or point, each below `vertices`.
fn indices(
    document: &Document<'_>,
    source: &Primitive,
    vertices: usize,
    name: &str,
    budget: &mut Budget,
) -> Result<IndexList, LoadProblem> {
    let bad = |problem: String| LoadProblem::BadPrimitive {
        primitive: name.to_owned(),
        problem,
    };
    let Checked::Valid(mode) = source.mode else {
        return Err(bad("its mode is unknown; 0 to 6 are".into()));
    };
    let accessor = match source.indices {
        None => None,
        Some(index) => {
            let accessor = Accessor::open(
                document,
                index.value(),
                &format!("the indices of {name}"),
                budget,
            )?;
            let unsigned = matches!(
                accessor.component,
                ComponentType::U8 | ComponentType::U16 | ComponentType::U32
            );
            accessor.expect(accessor.shape == Type::Scalar && unsigned, "indices")?;
            Some(accessor)
        }
    };
    let length = accessor
        .as_ref()
        .map_or(vertices, |accessor| accessor.count);
    let (topology, count) = match mode {
        Mode::Points => (Topology::Points, length),
        Mode::Lines => (Topology::Lines, length / 2),
        Mode::LineLoop => (Topology::Lines, if length < 2 { 0 } else { length }),
        Mode::LineStrip => (Topology::Lines, length.saturating_sub(1)),
        Mode::Triangles => (Topology::Triangles, length / 3),
        Mode::TriangleStrip | Mode::TriangleFan => (Topology::Triangles, length.saturating_sub(2)),
    };
    let whole = match mode {
        Mode::Lines => length.is_multiple_of(2),
        Mode::Triangles => length.is_multiple_of(3),
        _ => true,
    };
    if !whole {
        return Err(bad(format!("{length} indices do not divide into {mode:?}")));
    }
    budget.triangles(count as u64)?;
    let at = |i: usize| match &accessor {
        None => Ok(i as u32),
        Some(accessor) => {
            let [index] = accessor.integers(i);
            if (index as usize) < vertices {
                return Ok(index);
            }
            Err(accessor.bad(format!(
                "element {i} is {index}, but there are only {vertices} vertices"
            )))
        }
    };
    let each = topology.indices_per_primitive();
    let mut found = Vec::with_capacity(count * each);
    for i in 0..count {
        let corners = match mode {
            Mode::Points => [i, 0, 0],
            Mode::Lines => [i * 2, i * 2 + 1, 0],
            Mode::LineLoop => [i, if i + 1 == length { 0 } else { i + 1 }, 0],
            Mode::LineStrip => [i, i + 1, 0],
            Mode::Triangles => [i * 3, i * 3 + 1, i * 3 + 2],
            // Every other triangle of a strip has the opposite winding.
            Mode::TriangleStrip => [i, i + 1 + i % 2, i + 2 - i % 2],
            Mode::TriangleFan => [i + 1, i + 2, 0],
        };
        for corner in corners.into_iter().take(each) {
            found.push(at(corner)?);
        }
    }
    Ok(IndexList {
        topology,
        indices: found,
    })
}

/// The vertices that the indices use, ascending; `None` for all of them. Primitives often share one large set of
/// vertices, and a copy of the whole set for each would take far more memory than the file.
fn used_vertices(indices: &[u32], count: usize) -> Option<Vec<u32>> {
    if indices.len() >= count {
        return None;
    }
    let mut used = indices.to_vec();
    used.sort_unstable();
    used.dedup();
    Some(used)
}
