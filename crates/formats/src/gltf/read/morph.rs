//! Morph targets: their displacements at rest, and those that animations need.

use super::accessor::Accessor;
use super::deformation::Deformation;
use super::document::Document;
use super::geometry::{Request, Vertices, same_count};
use crate::budget::Budget;
use crate::error::LoadProblem;
use antumbra_scene::Geometry;
use antumbra_scene::animation::MorphTarget;
use gltf::json::accessor::Type;
use gltf::json::mesh::Primitive;

/// Bytes a vertex of a target that is kept.
const TARGET_VERTEX: u64 = 24;

/// Adds the displacements at rest, and keeps all targets where the primitive deforms.
pub(super) fn apply(
    document: &Document<'_>,
    source: &Primitive,
    request: &Request<'_>,
    vertices: &Vertices<'_>,
    budget: &mut Budget,
    geometry: &mut Geometry,
    mut deformation: Option<&mut Deformation>,
) -> Result<(), LoadProblem> {
    let name = request.label(document);
    let count = vertices.count() as u64;
    for (number, target) in source.targets.iter().flatten().enumerate() {
        let weight = request.weights.get(number).copied().unwrap_or(0.0);
        if weight == 0.0 && deformation.is_none() {
            continue;
        }
        budget.work(count)?;
        if deformation.is_some() {
            budget.memory(count.saturating_mul(TARGET_VERTEX))?;
        }
        let mut read = |index: usize| {
            let user = format!("morph target {number} of {name}");
            let deltas = Accessor::open(document, index, &user, budget)?;
            deltas.expect(deltas.shape == Type::Vec3, "displacements")?;
            same_count(&deltas, vertices.all)?;
            vertices
                .iter()
                .map(|vertex| deltas.finite::<3>(vertex))
                .collect()
        };
        let mut read = |index: Option<usize>| index.map_or_else(|| Ok(Vec::new()), &mut read);
        let mut target = MorphTarget {
            positions: read(target.positions.map(|index| index.value()))?,
            normals: read(target.normals.map(|index| index.value()))?,
        };
        if geometry.normals.is_empty() {
            target.normals = Vec::new();
        }
        if weight != 0.0 {
            target.add_to(weight, &mut geometry.positions, &mut geometry.normals);
        }
        if let Some(deformation) = &mut deformation {
            deformation.targets.push(target);
        }
    }
    Ok(())
}
