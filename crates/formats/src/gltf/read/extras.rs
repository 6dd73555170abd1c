//! The parts of nodes that the crate `gltf` leaves as plain JSON: MSFT_lod, EXT_mesh_gpu_instancing, and the extras
//! that `save_glb` writes.

use super::accessor::Accessor;
use super::document::Document;
use crate::budget::Budget;
use crate::error::LoadProblem;
use glam::{DAffine3, Quat, Vec3};
use gltf::json::accessor::Type;
use gltf::json::scene::Node;
use serde::Deserialize;

/// The part of a node's extras that is read.
#[derive(Deserialize)]
struct Extras {
    tested: bool,
}

/// Whether a test may cull the entity of a node: false if its extras have `"tested": false`.
pub(super) fn tested(node: &Node) -> bool {
    let extras = node.extras.as_ref().map(|extras| extras.get());
    // Serde would read an array as the members in their order.
    let object = extras.filter(|extras| extras.starts_with('{'));
    // Extras may contain anything. Other values have no effect.
    let extras = object.and_then(|object| serde_json::from_str::<Extras>(object).ok());
    extras.is_none_or(|extras| extras.tested)
}

/// The nodes of the coarser levels of detail of `node`, finest first. Invalid indices are ignored.
pub(super) fn lods(node: &Node) -> Vec<usize> {
    let ids = extension(node, "MSFT_lod").and_then(|lod| lod.get("ids")?.as_array());
    let ids = ids.into_iter().flatten();
    ids.filter_map(|id| usize::try_from(id.as_u64()?).ok())
        .collect()
}

/// The transforms of the instances of a node's mesh, relative to the node; `None` without instancing.
pub(super) fn instances(
    document: &Document<'_>,
    index: usize,
    node: &Node,
    budget: &mut Budget,
) -> Result<Option<Vec<DAffine3>>, LoadProblem> {
    let attributes =
        extension(node, "EXT_mesh_gpu_instancing").and_then(|e| e.get("attributes")?.as_object());
    let Some(attributes) = attributes else {
        return Ok(None);
    };
    let mut open = |name: &str, shape: Type| {
        let accessor = attributes.get(name).and_then(|value| value.as_u64());
        let Some(accessor) = accessor.and_then(|value| usize::try_from(value).ok()) else {
            return Ok(None);
        };
        let user = format!("the instances' {name} of {}", document.node_label(index));
        let accessor = Accessor::open(document, accessor, &user, budget)?;
        accessor.expect(accessor.shape == shape, name)?;
        Ok::<_, LoadProblem>(Some(accessor))
    };
    let translations = open("TRANSLATION", Type::Vec3)?;
    let rotations = open("ROTATION", Type::Vec4)?;
    let scales = open("SCALE", Type::Vec3)?;
    let all = || [&translations, &rotations, &scales].into_iter().flatten();
    let count = all().map(|accessor| accessor.count).max().unwrap_or(0);
    if let Some(odd) = all().find(|accessor| accessor.count != count) {
        let problem = format!("{} elements where another attribute has {count}", odd.count);
        return Err(odd.bad(problem));
    }
    budget.entities(count as u64)?;
    let mut instances = Vec::with_capacity(count);
    for i in 0..count {
        let translation = match &translations {
            Some(accessor) => accessor.finite(i)?,
            None => [0.0; 3],
        };
        let rotation = match &rotations {
            Some(accessor) => accessor.finite(i)?,
            None => Quat::IDENTITY.to_array(),
        };
        let scale = match &scales {
            Some(accessor) => accessor.finite(i)?,
            None => [1.0; 3],
        };
        let rotation = Quat::from_array(rotation).as_dquat();
        let length = rotation.length();
        instances.push(DAffine3::from_scale_rotation_translation(
            Vec3::from(scale).as_dvec3(),
            if length > 0.0 {
                rotation / length
            } else {
                glam::DQuat::IDENTITY
            },
            Vec3::from(translation).as_dvec3(),
        ));
    }
    Ok(Some(instances))
}

fn extension<'a>(node: &'a Node, name: &str) -> Option<&'a gltf::json::Value> {
    node.extensions.as_ref()?.others.get(name)
}
